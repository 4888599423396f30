// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_homography.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "calib/start/board_pose.h"
#include "calib/start/refine_views.h"
#include "core/camera.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Rigid3 tilted_pose(double degrees, const Vector3d& axis, const Vector3d& place) {
  Rigid3 pose;
  pose.rotation = Eigen::AngleAxisd(degrees * 3.14159265358979 / 180, axis.normalized());
  pose.translation = place;
  return pose;
}

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

TEST(BoardHomography, GivesBackThePoseOfExactRays) {
  const Rigid3 truth = tilted_pose(35, {1, 0.3, -0.2}, {-20, 15, 400});
  std::vector<Vector2d> board, rays;
  for (int i = 0; i < 20; ++i) {
    board.emplace_back(10 * (i % 5), 10 * (i / 5));
    rays.push_back((truth * Vector3d(board.back().x(), board.back().y(), 0)).hnormalized());
  }
  const auto H = find_homography(board, rays);
  ASSERT_TRUE(H);
  const Rigid3 pose = pose_from_homography(*H);
  EXPECT_LT(pose.rotation.angularDistance(truth.rotation), 1e-9);
  EXPECT_LT((pose.translation - truth.translation).norm(), 1e-7);
}

TEST(BoardHomography, PointsOnALineHaveNone) {
  std::vector<Vector2d> line, image;
  for (int i = 0; i < 8; ++i) line.emplace_back(10.0 * i, 5.0 * i), image.emplace_back(3.0 * i, 7.0);
  EXPECT_FALSE(find_homography(line, image));
  EXPECT_FALSE(find_homography(std::span(line).first(3), std::span(image).first(3)));
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

}  // namespace
}  // namespace lightstripe
