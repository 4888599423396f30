// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided_between.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

/// y = x^3 / 64, whose tangent is (1, 3 x^2 / 64).
double height(double x) { return x * x * x / 64; }
Direction tangent(double x) {
  const double slope = 3 * x * x / 64, length = std::hypot(1, slope);
  return {1 / length, slope / length};
}

TEST(Between, ACubicComesBackExactly) {
  const RidgePlace a{0, height(0), tangent(0), 8}, b{4, height(4), tangent(4), 4};
  std::vector<StripePoint> points;
  append_between(a, b, 4, points);
  ASSERT_EQ(points.size(), 3U);
  for (int k = 1; k < 4; ++k) {
    const StripePoint& p = points[static_cast<std::size_t>(k - 1)];
    EXPECT_EQ(p.x, k);
    EXPECT_NEAR(p.y, height(k), 1e-12);
    EXPECT_NEAR(p.strength, 8 - k, 1e-12);
    EXPECT_NEAR(std::hypot(p.normal_x, p.normal_y), 1, 1e-9);
    EXPECT_GT(p.normal_y, 0);
  }
}

TEST(Between, RowWiseLinesRunAlongY) {
  RidgePlace a{height(0), 0, {tangent(0).y, tangent(0).x}, 1},
      b{height(4), 4, {tangent(4).y, tangent(4).x}, 1};
  b.direction = {0.6, 0.8}, a.direction = {0.6, 0.8};  // a straight line
  b.x = a.x + 3;
  std::vector<StripePoint> points;
  append_between(a, b, 4, points);
  ASSERT_EQ(points.size(), 3U);
  for (int k = 1; k < 4; ++k) {
    EXPECT_EQ(points[static_cast<std::size_t>(k - 1)].y, k);
    EXPECT_NEAR(points[static_cast<std::size_t>(k - 1)].x, 0.75 * k, 1e-12);
    EXPECT_NEAR(points[static_cast<std::size_t>(k - 1)].normal_x, -0.8, 1e-12);
  }
}

// Pixel k of means of 4 x 4 has its centre at 4 k + 1.5.
TEST(Between, BinnedPointsBecomeOneAColumn) {
  std::vector<StripePoint> binned(3), full;
  for (int i = 0; i < 3; ++i) {
    StripePoint& p = binned[static_cast<std::size_t>(i)];
    p.x = i, p.y = 2 + 0.5 * i, p.strength = 16;
    p.normal_x = -0.5 / std::hypot(1, 0.5), p.normal_y = 1 / std::hypot(1, 0.5);
  }
  append_in_full_image(binned, 2, full);
  ASSERT_EQ(full.size(), 8U);  // columns 2 to 9, between 1.5 and 9.5
  for (std::size_t k = 0; k < full.size(); ++k) {
    EXPECT_EQ(full[k].x, 2.0 + static_cast<double>(k));
    EXPECT_NEAR(full[k].y, 9.5 + 0.5 * (full[k].x - 1.5), 1e-9);
    EXPECT_NEAR(full[k].strength, 1, 1e-12);  // a second derivative shrinks by the area
  }
}

TEST(Between, ALongStepIsAGap) {
  std::vector<StripePoint> binned(2), full;
  binned[0].normal_y = binned[1].normal_y = 1;
  binned[1].x = 3.5;
  append_in_full_image(binned, 1, full);
  EXPECT_TRUE(full.empty());
}

}  // namespace
}  // namespace lightstripe
