// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/link_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

/// Line points in a row, a quarter pixel below the pixels' centres.
void add_row(LinePointMap& map, int y, int from, int to, float strength) {
  for (int x = from; x <= to; ++x) {
    const std::size_t i = map.index(x, y);
    map.strength[i] = strength;
    map.offset_x[i] = 0, map.offset_y[i] = 0.25F;
    map.normal_x[i] = 0, map.normal_y[i] = 1;
  }
}

LinePointMap empty_map() {
  LinePointMap map;
  map.reset(30, 20);
  return map;
}

TEST(LinkPoints, ARowBecomesOneLineInOrder) {
  LinePointMap map = empty_map();
  add_row(map, 4, 2, 15, 5);
  LineSet lines;
  link_points(map, 5, lines);
  ASSERT_EQ(lines.lines.size(), 1U);
  ASSERT_EQ(lines.points.size(), 14U);
  const double step = lines.points[1].x - lines.points[0].x;
  EXPECT_EQ(std::abs(step), 1);
  for (std::size_t i = 0; i < 14; ++i) {
    EXPECT_EQ(lines.points[i].x, lines.points[0].x + step * static_cast<double>(i));
    EXPECT_EQ(lines.points[i].y, 4.25);
    EXPECT_EQ(lines.points[i].normal_y, lines.points[0].normal_y);  // on one side
  }
}

TEST(LinkPoints, OneStrongPointStartsAWeakLine) {
  LinePointMap map = empty_map();
  add_row(map, 4, 2, 15, 5);
  LineSet none, one;
  link_points(map, 8, none);
  EXPECT_TRUE(none.lines.empty());
  map.strength[map.index(9, 4)] = 8;
  link_points(map, 8, one);
  ASSERT_EQ(one.lines.size(), 1U);
  EXPECT_EQ(one.lines[0].size(), 14U);
}

TEST(LinkPoints, RowsApartStayApartAndCrumbsAreNoLine) {
  LinePointMap map = empty_map();
  add_row(map, 4, 2, 15, 5);
  add_row(map, 8, 2, 9, 6);
  add_row(map, 15, 2, 5, 7);  // four points
  LineSet lines;
  link_points(map, 1, lines);
  ASSERT_EQ(lines.lines.size(), 2U);
  EXPECT_EQ(lines.lines[0].size(), 8U);  // the stronger one comes first
  EXPECT_EQ(lines.lines[1].size(), 14U);
}

// A ridge of curvature -4 whose slope is dy here has its top dy / 4 farther on.
TEST(LinePointMap, TakesRidgesInsideThePixel) {
  LinePointMap map = empty_map();
  Derivatives d;
  d.dyy = -4, d.dy = 1;
  map.test_pixel(3, 7, d, 2);
  EXPECT_EQ(map.strength[map.index(3, 7)], 4);
  EXPECT_NEAR(map.offset_y[map.index(3, 7)], 0.25, 1e-7);
  EXPECT_NEAR(map.offset_x[map.index(3, 7)], 0, 1e-7);
  d.dy = 3;  // 0.75 px: in the next pixel
  map.test_pixel(4, 7, d, 2);
  EXPECT_EQ(map.strength[map.index(4, 7)], 0);
  d.dy = 1, d.dyy = 4;  // dark
  map.test_pixel(5, 7, d, 2);
  EXPECT_EQ(map.strength[map.index(5, 7)], 0);
}

TEST(RefinePoints, MoveOntoTheRidge) {
  constexpr double kTruth = 20.3;
  Image16 image(60, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x)
      image(x, y) = static_cast<std::uint16_t>(20000 * std::exp(-std::pow(y - kTruth, 2) / 8));
  LineSet lines;
  for (int x = 20; x < 40; ++x) {
    StripePoint& p = lines.points.emplace_back();
    p.x = x, p.y = 20, p.normal_y = 1;
  }
  refine_points(image.view(), make_derivative_kernels(2), lines);
  // The strength is that of the place where the step begins, 0.3 px beside the ridge: of a Gaussian of the
  // variance s^2 + sigma^2 = 8.
  const double strength = 20000 * 2 / std::pow(8, 1.5) * (1 - 0.09 / 8) * std::exp(-0.09 / 16);
  for (const StripePoint& p : lines.points) {
    EXPECT_NEAR(p.y, kTruth, 0.005);  // t^3 / (s^2 + sigma^2)
    EXPECT_NEAR(p.strength, strength, 0.002 * strength);
  }
}

}  // namespace
}  // namespace lightstripe
