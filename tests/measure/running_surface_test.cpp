// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/running_surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

using Eigen::Vector2d;

TEST(HeightTable, CubicsAreReadExactly) {
  HeightTable table{-5, 0.5, {}};
  const auto cubic = [](double y) { return y * y * y / 10 - y * y + 2; };
  for (double y = -5; y <= 5; y += 0.5) table.height_mm.push_back(cubic(y));
  EXPECT_EQ(table.last_mm(), 5);
  for (const double y : {-4.3, -0.1, 0.0, 2.22, 4.9, 5.6}) EXPECT_NEAR(table.at(y), cubic(y), 1e-9) << y;
  // Over two steps the slope of a cubic is larger by its third derivative times step^2 / 6.
  EXPECT_NEAR(table.slope_at(1), 0.3 - 2 + 0.1 * 0.25, 1e-9);
}

TEST(RunningSurface, ExactPointsAreTabulatedAsTheyAre) {
  std::vector<Vector2d> points;
  for (double y = -10.03; y <= 10; y += 0.37) points.emplace_back(y, y * y / 50);
  const RunningSurface surface = RunningSurface::exact(points);
  EXPECT_EQ(surface.sigma_mm(), 0);
  EXPECT_NEAR(surface.table().at(3.21), 3.21 * 3.21 / 50, 1e-9);
  Random random(1);
  EXPECT_EQ(surface.redrawn(random).height_mm, surface.table().height_mm);
}

// Of 600 points the scatter is known to 3 %; the smoothing takes most of it away.
TEST(RunningSurface, NoiseIsMeasuredAndSmoothed) {
  Random random(4);
  std::vector<Vector2d> points;
  for (double y = -30; y <= 30; y += 0.1) points.emplace_back(y, y * y / 600 + 0.02 * random.gaussian());
  const RunningSurface surface = RunningSurface::measured(points, {});
  EXPECT_NEAR(surface.sigma_mm(), 0.02, 0.003);
  double squares = 0, redraws = 0;
  const HeightTable drawn = surface.redrawn(random);
  int count = 0;
  for (double y = -25; y <= 25; y += 0.5, ++count) {
    squares += std::pow(surface.table().at(y) - y * y / 600, 2);
    redraws += std::pow(drawn.at(y) - surface.table().at(y), 2);
  }
  EXPECT_LT(std::sqrt(squares / count), 0.006);
  EXPECT_LT(std::sqrt(redraws / count), 0.012);
  EXPECT_GT(redraws, 0);
}

}  // namespace
}  // namespace lightstripe
