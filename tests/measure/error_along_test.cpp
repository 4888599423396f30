// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/error_along.h"

#include <gtest/gtest.h>

#include <cmath>

#include "chain.h"
#include "core/random.h"

namespace lightstripe {
namespace {

// An autoregressive chain beside independent noise: both are told apart. 200 stretches know the shared part
// to some 7 %.
TEST(ErrorAlong, IsTakenApartIntoItsOwnAndTheSharedPart) {
  Chain chain;
  Random random(6);
  const double a = std::exp(-0.1 / 2);
  double last = 0;
  for (int i = 0; i < 8000; ++i) {
    last = a * last + std::sqrt(1 - a * a) * 0.02 * random.gaussian();
    chain.add(0.1 * i, last + 0.01 * random.gaussian());
  }
  const ErrorAlong error = error_along(chain.section, chain.points);
  EXPECT_NEAR(error.own_mm, 0.01, 0.003);
  EXPECT_NEAR(error.shared_mm, 0.02, 0.003);
  EXPECT_NEAR(error.length_mm, 2, 0.05);  // the pose's share lengthens it
}

TEST(ErrorAlong, OfIndependentNoiseSharesNothing) {
  int shared = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    Chain chain;
    Random random(static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 500; ++i) chain.add(0.1 * i, 0.02 * random.gaussian());
    const ErrorAlong error = error_along(chain.section, chain.points);
    EXPECT_NEAR(error.own_mm, 0.02, 0.003);
    shared += error.shared_mm > 0 ? 1 : 0;
  }
  EXPECT_LE(shared, 2);
}

// By the double sum over all pairs, in any order.
TEST(ErrorAlong, SigmaOfASumCountsWhatNeighboursShare) {
  const ErrorAlong error{0.01, 0.03, 2};
  const std::vector<double> places{3, 0, 0.5, 7}, factors{0.4, 0.3, -0.2, 0.5};
  double variance = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < places.size(); ++k)
      variance += factors[i] * factors[k] *
                  ((i == k ? 0.01 * 0.01 : 0) + 0.03 * 0.03 * std::exp(-std::abs(places[i] - places[k]) / 2));
  EXPECT_NEAR(sigma_of_sum(error, places, factors), std::sqrt(variance), 1e-12);
}

}  // namespace
}  // namespace lightstripe
