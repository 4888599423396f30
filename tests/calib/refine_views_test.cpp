// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/refine_views.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "calib/observations.h"
#include "calib/start/board_pose.h"
#include "core/camera.h"
#include "tilted_pose.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::tilted_pose;

Target board_8_by_6() {
  Target target;
  target.type = TargetType::kCheckerboard;
  target.columns = 8;
  target.rows = 6;
  target.pitch_x = target.pitch_y = 10;
  return target;
}

std::vector<Vector2d> seen(const Camera& camera, const Target& target, const Rigid3& pose) {
  std::vector<Vector2d> out;
  for (int i = 0; i < target.num_corners(); ++i) {
    const Vector2d p = target.corner(i);
    out.push_back(*project(camera, pose * Vector3d(p.x(), p.y(), 0)));
  }
  return out;
}

TEST(RefineViews, FindsTheCameraFromAWrongStart) {
  const Target target = board_8_by_6();
  const Camera truth{960, 700, 1640, 1638, 486, 343, {-0.1, 0.05, 0.001, -0.0005}};
  std::vector<Rigid3> poses;
  std::vector<std::vector<Vector2d>> corners;
  for (int i = 0; i < 8; ++i) {
    poses.push_back(tilted_pose(20 + 3 * i, {std::cos(0.8 * i), std::sin(0.8 * i), 0.1},
                                {-60.0 + 10 * i, -20, 450.0 + 10 * (i % 3)}));
    corners.push_back(seen(truth, target, poses.back()));
  }
  Camera camera{960, 700, 1500, 1500, 479.5, 349.5, {}};
  std::vector<const std::vector<Vector2d>*> views;
  std::vector<Rigid3> found;
  for (const auto& view : corners) {
    views.push_back(&view);
    const auto pose = board_pose(camera, target, view);
    ASSERT_TRUE(pose);
    found.push_back(*pose);
  }
  ASSERT_TRUE(refine_camera(camera, target, views, found));
  EXPECT_NEAR(camera.fx, truth.fx, 1e-3);
  EXPECT_NEAR(camera.cy, truth.cy, 1e-3);
  EXPECT_NEAR(camera.distortion[0], truth.distortion[0], 1e-5);
  EXPECT_LT((found[3].translation - poses[3].translation).norm(), 1e-3);
}

TEST(RefinePose, ReachesTheTruthFromBesideItAndWithoutHalfOfTheCorners) {
  const Target target = board_8_by_6();
  const Camera camera{960, 700, 1640, 1638, 486, 343, {-0.1, 0.05, 0.001, -0.0005}};
  const Rigid3 truth = tilted_pose(25, {1, 0.4, 0}, {-30, -20, 450});
  std::vector<Vector2d> corners = seen(camera, target, truth);
  for (std::size_t i = 0; i < corners.size(); i += 2) corners[i] = unseen_corner();
  Rigid3 pose = tilted_pose(20, {1, 0.3, 0}, {-25, -22, 440});
  ASSERT_TRUE(refine_pose(camera, target, corners, pose));
  EXPECT_LT(pose.rotation.angularDistance(truth.rotation), 1e-7);
  EXPECT_LT((pose.translation - truth.translation).norm(), 1e-5);
}

}  // namespace
}  // namespace lightstripe
