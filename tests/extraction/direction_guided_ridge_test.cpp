// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided_ridge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

constexpr double kSlope = 0.3, kPeak = 20000;
const double kLength = std::hypot(1, kSlope);

double line_at(double x) { return 30 + kSlope * x; }

/// A Gaussian line of sigma 2 px.
class RidgeTest : public ::testing::Test {
 protected:
  Image16 image = [] {
    Image16 out(100, 90);
    for (int y = 0; y < out.height; ++y)
      for (int x = 0; x < out.width; ++x)
        out(x, y) =
            static_cast<std::uint16_t>(kPeak * std::exp(-std::pow((y - line_at(x)) / kLength, 2) / 8));
    return out;
  }();
  DerivativeKernels kernels = make_derivative_kernels(2);
  RidgeLimits limits;
  std::vector<std::uint16_t> border;
  RidgeFinder<std::uint16_t> finder{image.view(), kernels, limits, border};

  RidgeSearch search_at(double x, double off) const {
    RidgeSearch search;
    search.x = x, search.y = line_at(x) + off;
    search.direction = {1 / kLength, kSlope / kLength};
    return search;
  }
};

TEST_F(RidgeTest, TheFirstPointLiesOnTheLineInAWholeColumn) {
  const auto found = finder.first_point(40, 44);  // 2 px beside it
  ASSERT_TRUE(found);
  EXPECT_EQ(found->x, std::round(found->x));
  EXPECT_NEAR(found->y, line_at(found->x), 0.002);
  // Kernels that end at 3.2 sigma are not quite round: directions guide, places measure.
  EXPECT_NEAR(std::abs(found->direction.y / found->direction.x), kSlope, 0.01);
  EXPECT_NEAR(found->strength, kPeak * kernels.matched_strength(), 0.01 * kPeak * kernels.matched_strength());
}

TEST_F(RidgeTest, AWrongPredictionIsMadeGood) {
  for (const double off : {-0.6, -0.2, 0.3, 0.7}) {
    const auto found = finder.find(search_at(50, off));
    ASSERT_TRUE(found) << off;
    EXPECT_EQ(found->x, 50);
    EXPECT_NEAR(found->y, line_at(50), 0.002) << off;
    EXPECT_EQ(found->clarity, RidgeClarity::kClear);
    EXPECT_GT(found->direction.x, 0);  // in the sense of the search
  }
}

TEST_F(RidgeTest, WhatIsFarWeakOrTurnedIsRefused) {
  EXPECT_FALSE(finder.find(search_at(50, 1.2)));  // reach 0.75
  RidgeSearch weak = search_at(50, 0);
  weak.least_strength = 1.05 * kPeak * kernels.matched_strength();
  EXPECT_FALSE(finder.find(weak));
  RidgeSearch turned = search_at(50, 0);
  turned.direction = turned.direction.rotated(std::cos(1.0), std::sin(1.0));  // cosine 0.54
  EXPECT_FALSE(finder.find(turned));
}

TEST_F(RidgeTest, NoLineBeginsOnDarkGround) { EXPECT_FALSE(finder.first_point(10, 80)); }

TEST(Direction, HalfWayBetweenTwoIsAUnitVector) {
  const Direction half = blended({1, 0}, {0, 1}, 0.5);
  EXPECT_NEAR(half.x, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(half.y, std::sqrt(0.5), 1e-12);
  const Direction small = blended({1, 0}, {std::cos(0.04), std::sin(0.04)}, 0.25);  // the series
  EXPECT_NEAR(std::hypot(small.x, small.y), 1, 1e-10);
}

TEST(NearestPixel, RoundsHalvesUpAlsoBelowZero) {
  EXPECT_EQ(nearest_pixel(2.5), 3);
  EXPECT_EQ(nearest_pixel(2.49), 2);
  EXPECT_EQ(nearest_pixel(-0.6), -1);
  EXPECT_EQ(nearest_pixel(-0.4), 0);
}

}  // namespace
}  // namespace lightstripe
