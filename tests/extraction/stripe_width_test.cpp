// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/stripe_width.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

/// A Gaussian stripe across the rows' middle, turned by this angle.
Image8 stripe(double sigma, double angle_deg) {
  Image8 image(320, 240);
  const double a = angle_deg * std::acos(-1.0) / 180;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double d = -std::sin(a) * (x - 160) + std::cos(a) * (y - 120.3);
      image(x, y) =
          static_cast<std::uint8_t>(std::lround(10 + 180 * std::exp(-0.5 * d * d / (sigma * sigma))));
    }
  return image;
}

TEST(StripeWidth, IsTwoRootThreeSigmaAtAnyAngle) {
  for (const double sigma : {1.5, 3.0, 6.0})
    for (const double angle : {0.0, 20.0, 40.0, 90.0}) {
      const auto width = estimate_stripe_width(stripe(sigma, angle).view(), 60, 20);
      ASSERT_TRUE(width) << sigma << " " << angle;
      EXPECT_NEAR(*width / (2 * std::sqrt(3.0) * sigma), 1, 0.12) << sigma << " " << angle;
    }
}

TEST(StripeWidth, NothingWithoutABrightMaximum) {
  EXPECT_FALSE(estimate_stripe_width(Image8(200, 200, 30).view(), 60, 20));
  EXPECT_FALSE(estimate_stripe_width(stripe(3, 0).view(), 200, 20));
}

}  // namespace
}  // namespace lightstripe
