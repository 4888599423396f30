// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/image_facts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

TEST(ImageFacts, StatisticsNeedSomeThousandPixels) {
  EXPECT_EQ(facts_thinning(100, 100), 1);
  EXPECT_EQ(facts_thinning(400, 400), 10);
  EXPECT_EQ(facts_thinning(1280, 1000), 80);
}

TEST(ImageFacts, TheBrightestPixelIsNeverMissed) {
  Image8 image(640, 480, 20);
  image(333, 217) = 201;
  const ImageFacts facts = look_at(image.view());
  EXPECT_EQ(facts.histogram.largest, 201);
  EXPECT_NEAR(facts.noise.seen, 1 / std::sqrt(12.0), 1e-6);  // quantisation
}

TEST(SeedContrast, FiveSigmaOrFourGreyLevels) {
  EXPECT_EQ(seed_contrast({0.5, 0.5}, 1), 4);
  EXPECT_EQ(seed_contrast({2, 2}, 1), 10);
  EXPECT_EQ(seed_contrast({2, 2}, 2), 5);  // the mean of 4 pixels
}

TEST(SeedBlock, GrowsWithTheNoise) {
  ImageFacts facts;
  facts.histogram.largest = 100;
  for (const auto& [noise, block] : {std::pair{5.0, 1}, {10.0, 2}, {15.0, 4}}) {
    facts.noise.seen = noise;
    EXPECT_EQ(seed_block(facts), block) << noise;
  }
}

TEST(RidgeLimits, FollowFromTheNoiseAndTheFaintestLine) {
  const DerivativeKernels kernels = make_derivative_kernels(2);
  const double matched = 1 / (2 * std::sqrt(2.0) * 4);  // of 1 grey level
  ImageFacts facts;
  facts.histogram.largest = 200;
  ExtractionResult result;
  result.threshold_low = 30, result.threshold_high = 90;
  const RidgeLimits quiet = ridge_limits(kernels, facts, {}, result);
  EXPECT_EQ(quiet.level_low, 30);
  EXPECT_EQ(quiet.level_high, 90);
  EXPECT_NEAR(quiet.start_strength, 3 * matched, 1e-9);
  EXPECT_NEAR(quiet.follow_strength, 1.5 * matched, 1e-9);
  EXPECT_NEAR(quiet.shaded_strength, 1.4 * 1.5 * matched, 1e-9);
  EXPECT_EQ(quiet.largest_gap, 8);
  facts.noise.seen = 10;
  ParsedOptions given;
  given.rule = ThresholdRule::kGiven;
  const RidgeLimits noisy = ridge_limits(kernels, facts, given, result);
  EXPECT_NEAR(noisy.start_strength, 70 * kernels.curvature_gain, 1e-9);
  EXPECT_NEAR(noisy.clear_strength, 120 * kernels.curvature_gain, 1e-9);
  EXPECT_TRUE(noisy.hard_levels);
  EXPECT_TRUE(std::isinf(noisy.shaded_strength));  // nothing below a given level is followed
}

TEST(ChooseLevels, GivenOnesAreTaken) {
  ParsedOptions given;
  given.rule = ThresholdRule::kGiven;
  given.given = {12, 34};
  ImageFacts facts = look_at(Image8(100, 100, 7).view());
  ExtractionResult result;
  choose_levels(facts, {}, given, result);
  EXPECT_EQ(result.threshold_low, 12);
  EXPECT_EQ(result.threshold_high, 34);
}

}  // namespace
}  // namespace lightstripe
