// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/robust_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

TEST(RobustLine, GivesAParabolaExactly) {
  std::vector<Sample1> samples;
  for (int i = -10; i <= 10; ++i) samples.push_back({0.3 * i, 2 - 0.3 * i * 0.5 + 0.09 * i * i * 0.25});
  const auto fit = fit_polynomial(samples, 2, 0.001);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->value, 2, 1e-9);
  EXPECT_NEAR(fit->slope, -0.5, 1e-9);
  EXPECT_NEAR(fit->curvature, 0.5, 1e-9);
}

TEST(RobustLine, AFifthOfWrongSamplesDoesNotMatter) {
  std::vector<Sample1> samples;
  for (int i = 0; i < 40; ++i) samples.push_back({0.1 * i - 2, i % 5 == 0 ? 3.0 : 1 + 0.001 * (i % 3)});
  const auto fit = fit_polynomial(samples, 1, 0.001);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->value, 1, 0.003);
  EXPECT_EQ(fit->num_samples, 32);
}

TEST(RobustLine, DoubtfulSamplesCountOnlyWhereThereIsNothingBetter) {
  std::vector<Sample1> samples;
  for (int i = 0; i < 30; ++i)
    samples.push_back({0.1 * i - 1.5, i % 2 == 0 ? 1.0 : 1.05, i % 2 == 0 ? 1.0 : 0.01});
  EXPECT_NEAR(fit_polynomial(samples, 1, 0.005)->value, 1.0, 0.002);
  for (Sample1& s : samples) s.value = 1.05, s.weight = 0.01;
  EXPECT_NEAR(fit_polynomial(samples, 1, 0.005)->value, 1.05, 1e-9);
}

TEST(RobustLine, TooFewSamplesGiveNothing) {
  EXPECT_FALSE(fit_polynomial({{0, 1}, {1, 1}}, 0, 0.01));
  EXPECT_FALSE(fit_polynomial({{0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}}, 1, 0.01));  // all in one place
}

// 2000 repeats: the ratio of variances is known to 3 %; Tukey's weights on 25 samples add some.
TEST(RobustLine, PredictedVarianceIsThatOfTheValue) {
  Random random(3);
  double squares = 0;
  constexpr int kRepeats = 2000;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    std::vector<Sample1> samples;
    for (int i = 0; i < 25; ++i) samples.push_back({0.3 * i - 8.5, 0.1 * random.gaussian()});
    const auto fit = fit_polynomial(samples, 1, 0.001);
    ASSERT_TRUE(fit);
    squares += fit->value * fit->value / (fit->rms * fit->rms * fit->value_factor) / kRepeats;
  }
  EXPECT_GT(squares, 0.75);
  EXPECT_LT(squares, 1.35);
}

// A sixth of the samples 8 sigma off: at Tukey's limit of 4.7 sigma they count nothing, at three times that
// they would move the level by half a sigma and more.
TEST(FitPolynomial, OutliersOfEightSigmaCountNothing) {
  Random random(21);
  std::vector<Sample1> samples;
  for (int i = 0; i < 240; ++i)
    samples.push_back({0.1 * i - 12, 0.01 * random.gaussian() + (i % 6 == 0 ? 0.08 : 0.0)});
  const auto fit = fit_polynomial(samples, 0, 1e-4);
  ASSERT_TRUE(fit);
  EXPECT_LT(std::abs(fit->value), 0.002);
}

}  // namespace
}  // namespace lightstripe
