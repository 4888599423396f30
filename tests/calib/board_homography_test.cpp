// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_homography.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/transform.h"
#include "tilted_pose.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::tilted_pose;

TEST(BoardHomography, GivesBackThePoseOfExactRays) {
  const Rigid3 truth = tilted_pose(35, {1, 0.3, -0.2}, {-20, 15, 400});
  std::vector<Vector2d> board, rays;
  for (int i = 0; i < 20; ++i) {
    board.emplace_back(10 * (i % 5), 10 * (i / 5));
    rays.push_back((truth * Vector3d(board.back().x(), board.back().y(), 0)).hnormalized());
  }
  const auto H = find_homography(board, rays);
  ASSERT_TRUE(H);
  const Rigid3 pose = pose_from_homography(*H, board.front());
  EXPECT_LT(pose.rotation.angularDistance(truth.rotation), 1e-9);
  EXPECT_LT((pose.translation - truth.translation).norm(), 1e-7);
}

TEST(BoardHomography, TheOriginOfALongBoardMayLieBehindTheCamera) {
  const Rigid3 truth = tilted_pose(60, {0, 1, 0}, {500, 15, -400});
  std::vector<Vector2d> board, rays;
  for (int i = 0; i < 400; ++i) {
    const Vector2d place(10 * (i % 100), 10 * (i / 100));
    const Vector3d p = truth * Vector3d(place.x(), place.y(), 0),
                   q = truth * Vector3d(-place.x(), place.y(), 0);
    for (const auto& [at, from] : {std::pair(p, place), std::pair(q, Vector2d(-place.x(), place.y()))})
      if (at.z() > 100 && at.head<2>().norm() < at.z())
        board.push_back(from), rays.push_back(at.hnormalized());
  }
  ASSERT_GT(board.size(), 20U);
  const auto H = find_homography(board, rays);
  ASSERT_TRUE(H);
  const Rigid3 pose = pose_from_homography(*H, board.front());
  EXPECT_LT(pose.rotation.angularDistance(truth.rotation), 1e-8);
  EXPECT_LT((pose.translation - truth.translation).norm(), 1e-5);
}

TEST(BoardHomography, PointsOnALineHaveNone) {
  std::vector<Vector2d> line, image;
  for (int i = 0; i < 8; ++i) line.emplace_back(10.0 * i, 5.0 * i), image.emplace_back(3.0 * i, 7.0);
  EXPECT_FALSE(find_homography(line, image));
  EXPECT_FALSE(find_homography(std::span(line).first(3), std::span(image).first(3)));
}

}  // namespace
}  // namespace lightstripe
