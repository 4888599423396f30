// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/robust.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/random.h"

namespace lightstripe {
namespace {

TEST(Median, OfAnEvenCountIsTheMeanOfTheMiddleTwo) {
  EXPECT_EQ(median({4, 1}), 2.5);
  EXPECT_EQ(median({9, 1, 3, 5}), 4);
  EXPECT_EQ(median({9, 1, 3}), 3);
}

TEST(UpperMedian, OfAnEvenCountIsTheUpperOne) {
  EXPECT_EQ(upper_median(std::vector<int>{4, 1}), 4);
  EXPECT_EQ(upper_median(std::vector<int>{9, 1, 3, 5}), 5);
  EXPECT_EQ(upper_median(std::vector<int>{9, 1, 3}), 3);
}

TEST(Median, OfNothingIsTheCallersFault) {
  EXPECT_THROW(median({}), std::logic_error);
  EXPECT_THROW(upper_median(std::vector<float>{}), std::logic_error);
  EXPECT_THROW(value_at_rank(std::vector<float>{1}, 1), std::logic_error);
}

// The weight halves at 0.541 of the limit: (1 - t^2)^2 = 1/2 at t^2 = 1 - sqrt(1/2).
TEST(TukeyWeight, FallsFromOneToNothingAtItsLimit) {
  EXPECT_EQ(tukey_weight(0), 1);
  EXPECT_NEAR(tukey_weight(-0.541196 * kTukeyLimit), 0.5, 1e-6);
  EXPECT_EQ(tukey_weight(kTukeyLimit), 0);
  EXPECT_EQ(tukey_weight(-100), 0);
}

// The figures that kTukeyLimit stands for: a mean weighted by it has the variance of the plain one over 0.95.
TEST(TukeyWeight, IsNinetyFivePerCentEfficientForNormalNoise) {
  Random random(1);
  double influence2 = 0, slope = 0;
  constexpr int kSamples = 400'000;
  for (int i = 0; i < kSamples; ++i) {
    const double r = random.gaussian(), t = r / kTukeyLimit;
    const double psi = r * tukey_weight(r);
    influence2 += psi * psi / kSamples;
    if (std::abs(t) < 1) slope += (1 - t * t) * (1 - 5 * t * t) / kSamples;
  }
  EXPECT_NEAR(slope * slope / influence2, 0.95, 0.01);
}

}  // namespace
}  // namespace lightstripe
