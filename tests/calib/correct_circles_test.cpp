// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The bias of a disc's picture against its picture sampled finely.
#include "calib/start/correct_circles.h"

#include <gtest/gtest.h>

#include "rendered_board.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

const Target kBoard{TargetType::kCircles, 7, 7, 30, 30};

/// Centre of gravity of the projected outline (Green's theorem over a polygon of 2000 corners).
Vector2d centroid(const Camera& camera, const Rigid3& pose, const Vector2d& middle, double diameter) {
  constexpr int kCorners = 2000;
  double area = 0;
  Vector2d sum = Vector2d::Zero();
  const auto at = [&](int i) {
    const double a = 2 * std::acos(-1.0) * i / kCorners;
    return *project(camera, pose * Eigen::Vector3d(middle.x() + 0.5 * diameter * std::cos(a),
                                                   middle.y() + 0.5 * diameter * std::sin(a), 0));
  };
  const Vector2d origin = at(0);
  for (int i = 0; i < kCorners; ++i) {
    const Vector2d p = at(i) - origin, q = at(i + 1) - origin;
    const double cross = p.x() * q.y() - p.y() * q.x();
    area += 0.5 * cross;
    sum += cross / 6 * (p + q);
  }
  return origin + sum / area;
}

TEST(DiscBias, IsThatOfTheSampledDisc) {
  const Camera camera{960, 700, 1100, 1100, 480, 350, {-0.2, 0.1, 1e-3, -1e-3}};
  double largest = 0;
  for (const double tilt : {0.0, 30.0, 45.0}) {
    const Rigid3 pose = testing::board_pose(kBoard, {10, -5, 420}, tilt, -0.5 * tilt, 5);
    for (const Vector2d& middle : {Vector2d(0, 0), Vector2d(90, 90), Vector2d(180, 150)}) {
      const Vector2d known = centroid(camera, pose, middle, 20) -
                             *project(camera, pose * Eigen::Vector3d(middle.x(), middle.y(), 0));
      const Vector2d bias = disc_bias_px(camera, pose, middle, 20);
      EXPECT_LT((bias - known).norm(), 0.003 + 0.03 * known.norm()) << tilt << " " << middle.transpose();
      largest = std::max(largest, known.norm());
    }
  }
  EXPECT_GT(largest, 0.1);  // there is something to correct
}

TEST(DiscBias, IsNothingBehindTheCamera) {
  const Camera camera{960, 700, 1100, 1100, 480, 350, {}};
  const Rigid3 behind{Eigen::Quaterniond::Identity(), {0, 0, -100}};
  EXPECT_EQ(disc_bias_px(camera, behind, {0, 0}, 20).norm(), 0);
}

}  // namespace
}  // namespace lightstripe
