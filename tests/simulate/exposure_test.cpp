// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lightstripe {
namespace {

struct Statistics {
  double mean = 0, variance = 0;
};

Statistics statistics_of(const Image8& image) {
  Statistics out;
  for (const std::uint8_t p : image.pixels) out.mean += p;
  out.mean /= static_cast<double>(image.pixels.size());
  for (const std::uint8_t p : image.pixels) out.variance += (p - out.mean) * (p - out.mean);
  out.variance /= static_cast<double>(image.pixels.size() - 1);
  return out;
}

// 200 000 pixels: the mean is known to sigma / 447 (3 levels: 0.007), the variance to 0.32 % (1 sigma).
// Rounding to whole levels adds 1/12. Bounds are 5 sigma.
TEST(Exposure, MeanAndVarianceFollowTheNoiseModel) {
  Imaging imaging;
  imaging.read_noise = 1.5;
  imaging.electrons_per_level = 40;
  imaging.dark_level = 5;
  for (const float level : {20.3F, 100.7F, 180.0F}) {
    const Statistics seen = statistics_of(expose(Image<float>(500, 400, level), imaging, 1, 2));
    const double variance = 1.5 * 1.5 + (static_cast<double>(level) - 5) / 40 + 1.0 / 12;
    EXPECT_NEAR(seen.mean, static_cast<double>(level), 5 * std::sqrt(variance / 2e5)) << level;
    EXPECT_NEAR(seen.variance, variance, 5 * 0.0032 * variance) << level;
  }
}

TEST(Exposure, NeighboursAreIndependent) {
  const Image8 image = expose(Image<float>(500, 400, 100), Imaging{}, 1, 2);
  const Statistics seen = statistics_of(image);
  double along = 0, down = 0;
  for (int y = 0; y + 1 < image.height; ++y)
    for (int x = 0; x + 1 < image.width; ++x) {
      along += (image(x, y) - seen.mean) * (image(x + 1, y) - seen.mean);
      down += (image(x, y) - seen.mean) * (image(x, y + 1) - seen.mean);
    }
  const double pairs = 499.0 * 399.0;  // a correlation of 0 is seen to 1 / sqrt(pairs) = 0.0022
  EXPECT_NEAR(along / pairs / seen.variance, 0, 0.011);
  EXPECT_NEAR(down / pairs / seen.variance, 0, 0.011);
}

TEST(Exposure, WithoutNoiseRoundsAndClips) {
  Imaging imaging;
  imaging.read_noise = 0;
  imaging.electrons_per_level = 0;
  Image<float> light(3, 1);
  light(0, 0) = -3;
  light(1, 0) = 41.6F;
  light(2, 0) = 700;
  const Image8 image = expose(light, imaging, 1, 2);
  EXPECT_EQ(image(0, 0), 0);
  EXPECT_EQ(image(1, 0), 42);
  EXPECT_EQ(image(2, 0), 255);
}

TEST(Exposure, SameSeedAndStreamGiveTheSameBitsOthersDoNot) {
  const Image<float> light(64, 48, 90);
  const Image8 image = expose(light, Imaging{}, 1, 2);
  EXPECT_EQ(image.pixels, expose(light, Imaging{}, 1, 2).pixels);
  EXPECT_NE(image.pixels, expose(light, Imaging{}, 2, 2).pixels);
  EXPECT_NE(image.pixels, expose(light, Imaging{}, 1, 3).pixels);
}

TEST(Blob, CoversItsEllipseAndFadesOverItsRim) {
  const Blob blob{100, 50, 10, 0.5, std::numbers::pi / 2};  // upright: 10 px along y, 5 along x
  EXPECT_NEAR(blob.cover(100, 50, 1), 1, 1e-4);
  EXPECT_NEAR(blob.cover(100, 60, 1), 0.5, 1e-12);
  EXPECT_NEAR(blob.cover(105, 50, 1), 0.5, 1e-12);
  EXPECT_LT(blob.cover(100, 70, 1), 1e-4);
}

TEST(Blob, SaturatesTheImageAndKeepsItsPlaceForASeed) {
  Reflections plan;
  plan.per_frame = 3;
  const auto blobs = draw_blobs(plan, 200, 100, Random(7));
  ASSERT_EQ(blobs.size(), 3U);
  EXPECT_EQ(blobs[2].x, draw_blobs(plan, 200, 100, Random(7))[2].x);
  Image<float> light(200, 100, 10);
  add_blobs(light, blobs, plan);
  for (const Blob& blob : blobs)
    EXPECT_GT(light(std::min(199, static_cast<int>(blob.x)), std::min(99, static_cast<int>(blob.y))), 255);
}

}  // namespace
}  // namespace lightstripe
