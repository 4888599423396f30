// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/correlation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "chain.h"
#include "core/random.h"

namespace lightstripe {
namespace {

// Each stretch of 8 mm is off by 0.02 as a whole: that is what a stretch errs by.
TEST(StretchError, IsTheOffsetThatAStretchShares) {
  Chain chain;
  Random random(3);
  for (int i = 0; i < 20 * 81; ++i)  // 81 points a stretch: a new one begins beyond 8 mm
    chain.add(0.1 * i, (i / 81 % 2 == 0 ? 0.02 : -0.02) + 0.002 * random.gaussian());
  EXPECT_NEAR(stretch_error_mm(chain.section, chain.points), 0.02, 0.002);
}

// Independent noise of 0.02: the mean of 81 points errs by 0.02 / 9.
TEST(StretchError, OfIndependentNoiseIsThatOfItsMean) {
  Chain chain;
  Random random(4);
  for (int i = 0; i < 60 * 81; ++i) chain.add(0.1 * i, 0.02 * random.gaussian());
  EXPECT_NEAR(stretch_error_mm(chain.section, chain.points), 0.02 / 9, 0.2 * 0.02 / 9);
}

// An autoregressive chain: 1 + 2 (a + a^2 + ...) = (1 + a) / (1 - a).
TEST(CorrelatedPoints, AreThoseOfAnAutoregressiveChain) {
  Chain chain;
  Random random(5);
  const double a = 0.8;
  double last = 0;
  for (int i = 0; i < 20000; ++i)
    chain.add(0.1 * i, last = a * last + std::sqrt(1 - a * a) * 0.01 * random.gaussian());
  EXPECT_NEAR(correlated_points(chain.section, chain.points), (1 + a) / (1 - a), 1.5);
}

// Correlation a^lag falls to 1/e over -1 / ln(a) points of 0.1 mm. An offset that a whole chain shares, a
// tenth of the variance, leaves the length nearly as it is and counts in full in correlated_points().
TEST(CorrelationLength, IsTheShortPartOnly) {
  const double a = 0.7, length = -0.1 / std::log(a);
  for (const double offset : {0.0, 0.0033}) {
    Chain chain;
    Random random(6);
    double last = 0;
    for (int i = 0; i < 20000; ++i) {
      last = a * last + std::sqrt(1 - a * a) * 0.01 * random.gaussian();
      chain.add(0.1 * i, last + (i / 200 % 2 == 0 ? offset : -offset));
    }
    EXPECT_NEAR(correlation_length_mm(chain.section, chain.points), length, 0.25 * length) << offset;
    if (offset > 0) {
      EXPECT_GT(correlated_points(chain.section, chain.points), 1.5 * (1 + a) / (1 - a));
    }
  }
}

}  // namespace
}  // namespace lightstripe
