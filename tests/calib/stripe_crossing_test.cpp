// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/stripe_crossing.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Camera kCamera{640, 480, 900, 905, 330, 236, {-0.1, 0.05}};
const Plane kBoard = canonical({Vector3d(0.1, -0.3, 1).normalized(), 500});
const Plane kLaser = canonical({Vector3d(0.05, 0.8, 0.6).normalized(), 290});

/// A pixel of the line where board and laser meet.
Vector2d on_line(double x_mm) {
  Eigen::Matrix3d A;
  A << kBoard.normal.transpose(), kLaser.normal.transpose(), 1, 0, 0;
  const Vector3d p = A.inverse() * Vector3d(kBoard.offset, kLaser.offset, x_mm);
  return project(kCamera, p).value();
}

TEST(StripeCrossing, MeasuresTheDistanceAcrossTheProjectedLine) {
  for (const double x : {-40.0, 0.0, 35.0}) {
    const Vector2d q = on_line(x);
    const auto here = stripe_crossing(kCamera, kBoard, kLaser, q);
    ASSERT_TRUE(here);
    EXPECT_NEAR(here->distance_px, 0, 1e-6);
    const Vector2d along = (on_line(x + 0.1) - on_line(x - 0.1)).normalized();
    EXPECT_NEAR(here->normal.dot(along), 0, 1e-3);
    // 2 px aside the line is 2 px away.
    const auto aside = stripe_crossing(kCamera, kBoard, kLaser, q + 2 * here->normal);
    ASSERT_TRUE(aside);
    EXPECT_NEAR(std::abs(aside->distance_px), 2, 0.01);
  }
}

TEST(StripeCrossing, ParallelPlanesHaveNone) {
  EXPECT_FALSE(stripe_crossing(kCamera, kBoard, {kBoard.normal, kBoard.offset + 20}, {330, 236}));
}

}  // namespace
}  // namespace lightstripe
