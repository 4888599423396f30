// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/scale_ladder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

template <class F>
Image16 image_of(const F& grey) {
  Image16 image(240, 240);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image(x, y) = static_cast<std::uint16_t>(grey(x, y));
  return image;
}

Image16 line_of(double sigma) {
  return image_of([=](int, int y) { return 20000 * std::exp(-0.5 * std::pow((y - 120) / sigma, 2)); });
}

TEST(ScaleLadder, HalfOctavesFromRungToRung) {
  EXPECT_EQ(ScaleLadder::sigma(0), 1);
  EXPECT_NEAR(ScaleLadder::sigma(1), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(ScaleLadder::sigma(8), 16);
  EXPECT_NEAR(ScaleLadder::normalisation(4), 8, 1e-12);  // 4^1.5
  EXPECT_EQ(ScaleLadder::level(2), 0);
  EXPECT_EQ(ScaleLadder::level(3), 1);
  EXPECT_EQ(ScaleLadder::level(8), 3);
}

TEST(KernelCache, PixelsOfALevelBlurThemselves) {
  KernelCache cache;
  EXPECT_NEAR(cache.of_rung(4, 0).sigma, 4, 0.02);
  EXPECT_NEAR(cache.of_rung(4, 1).sigma, std::sqrt(16 - 0.5) / 2, 0.01);  // (2^2 - 1) / 6
  EXPECT_EQ(&cache.nearest(2.0), &cache.nearest(2.02));
  EXPECT_NE(&cache.nearest(2.0), &cache.nearest(2.2));
}

TEST(ImagePyramid, LevelsAreMeansDownToSmallOnes) {
  const Image16 image = image_of([](int x, int y) { return 100 * x + y; });
  ImagePyramid<std::uint16_t> pyramid;
  build_pyramid(image.view(), 8, pyramid);
  ASSERT_EQ(pyramid.count, 4);
  EXPECT_EQ(pyramid.levels[3].width, 30);
  EXPECT_NEAR(pyramid.levels[1](5, 7), 100 * 10.5 + 14.5, 0.51);
  EXPECT_NEAR(pyramid.noise[1], 4, 1e-9);
}

// t^(3/4) A s / (s^2 + t)^(3/2) is largest at t = s^2.
TEST(BestScale, IsTheLinesOwn) {
  KernelCache cache;
  for (const double sigma : {1.5, 3.0, 6.0}) {
    const Image16 image = line_of(sigma);
    ImagePyramid<std::uint16_t> pyramid;
    build_pyramid(image.view(), 1, pyramid);
    const auto found = best_scale(pyramid, cache, 120, 120.6, 0, ScaleLadder::kRungs - 1);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->sigma, sigma, 0.04 * sigma);
    EXPECT_NEAR(found->normalised, 20000 / std::sqrt(8 * sigma), 0.04 * 20000 / std::sqrt(8 * sigma));
    std::vector<StripePoint> points(60);
    for (int i = 0; i < 60; ++i) {
      StripePoint& p = points[static_cast<std::size_t>(i)];
      p.x = 90 + i, p.y = 120, p.normal_y = 1;
    }
    EXPECT_NEAR(scale_of_line(pyramid, cache, points, 1.5 * sigma), sigma, 0.04 * sigma);
  }
}

TEST(BestScale, ADotIsNoLine) {
  const Image16 image = image_of(
      [](int x, int y) { return 20000 * std::exp(-(std::pow(x - 120, 2) + std::pow(y - 120, 2)) / 18); });
  ImagePyramid<std::uint16_t> pyramid;
  build_pyramid(image.view(), 1, pyramid);
  KernelCache cache;
  EXPECT_FALSE(best_scale(pyramid, cache, 120, 120, 0, ScaleLadder::kRungs - 1));
}

// Five points high, five low: every second difference over 2.5 sigma = 5 points is 40 in magnitude.
TEST(GrainOfLine, IsWhatTheNoiseDoesNotExplain) {
  std::vector<StripePoint> points(200);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].strength = i / 5 % 2 == 0 ? 110 : 90;
  std::vector<float> scratch;
  const double seen = 1.4826 / std::sqrt(6.0) * 40;
  EXPECT_NEAR(grain_of_line(points, 2, 5, scratch), std::sqrt(seen * seen - 25) / 100, 1e-3);
  EXPECT_EQ(grain_of_line(points, 2, 17, scratch), 0);                      // 24.2 is less than 1.5 x 17
  EXPECT_EQ(grain_of_line(std::span(points).first(30), 2, 5, scratch), 0);  // too short to tell
}

}  // namespace
}  // namespace lightstripe
