// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

Image8 noisy(double level, double sigma, double slope_per_px = 0) {
  Random random(4);
  Image8 image(400, 300);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image(x, y) = static_cast<std::uint8_t>(
          std::clamp(std::lround(level + slope_per_px * x + sigma * random.gaussian()), 0L, 255L));
  return image;
}

TEST(Noise, IsThatOfTheImageWhateverItsBrightnessAndSlope) {
  for (const double sigma : {1.5, 4.0, 12.0}) {
    const double rounded = std::hypot(sigma, 1 / std::sqrt(12.0));
    EXPECT_NEAR(estimate_noise(noisy(120, sigma).view()).seen / rounded, 1, 0.04) << sigma;
    EXPECT_NEAR(estimate_noise(noisy(60, sigma, 0.3).view()).seen / rounded, 1, 0.04) << sigma;
  }
}

TEST(Noise, ClippedAtBlackTheFullNoiseIsMadeGood) {
  const NoiseEstimate clipped = estimate_noise(noisy(0, 8).view());
  EXPECT_LT(clipped.seen, 6.5);
  EXPECT_NEAR(clipped.full / 8, 1, 0.15);
}

TEST(Noise, AnEvenImageHasThatOfRounding) {
  EXPECT_NEAR(estimate_noise(Image8(100, 100, 50).view()).seen, 1 / std::sqrt(12.0), 1e-6);
}

TEST(Noise, ASixthOfThePixelsSaysTheSame) {
  const Image8 image = noisy(120, 6);
  EXPECT_NEAR(estimate_noise(image.view(), 6).seen / estimate_noise(image.view()).seen, 1, 0.06);
}

}  // namespace
}  // namespace lightstripe
