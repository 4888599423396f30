// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/closest_points.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace lightstripe {
namespace {

// Tukey's limit lies at 4.7 robust scales: beyond it a point counts nothing, well within nearly all.
TEST(Weigh, LeavesOutWhatLiesBeyondTukeysLimit) {
  Random random(2);
  std::vector<FitPoint> points(201);
  for (FitPoint& point : points) {
    point.normal = Eigen::Vector2d::UnitY();
    point.residual = 0.01 * random.gaussian();
  }
  points[0].residual = 0.07, points[1].residual = 0.004;
  ZoneMask all;
  all.fill(true);
  weigh(points, all, 1e-4, 1);
  EXPECT_EQ(points[0].weight, 0);
  EXPECT_GT(points[1].weight, 0.9);
}

}  // namespace
}  // namespace lightstripe
