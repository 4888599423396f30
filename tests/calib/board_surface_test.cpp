// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/board_surface.h"

#include <gtest/gtest.h>

#include "rendered_board.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Target kTarget{TargetType::kCheckerboard, 11, 8, 10, 10};  // 100 x 70 mm

TEST(BoardSurface, TheBowIsLargestInTheMiddleAndNoneAtTheEnds) {
  const Vector2d warp(0.3, -0.2);
  EXPECT_NEAR(board_place(kTarget, {50, 35}).point(warp).z(), 0.1, 1e-12);
  EXPECT_NEAR(board_place(kTarget, {0, 35}).point(warp).z(), -0.2, 1e-12);
  EXPECT_NEAR(board_place(kTarget, {100, 70}).point(warp).z(), 0, 1e-12);
}

TEST(BoardSurface, SlopesAreTheHeightsDerivatives) {
  const Vector2d warp(0.3, -0.2), at(31, 52);
  const auto z = [&](double dx, double dy) {
    return board_place(kTarget, at + Vector2d(dx, dy)).point(warp).z();
  };
  const Vector3d normal = board_place(kTarget, at).normal(warp);
  EXPECT_NEAR(normal.x(), -(z(1e-3, 0) - z(-1e-3, 0)) / 2e-3, 1e-8);
  EXPECT_NEAR(normal.y(), -(z(0, 1e-3) - z(0, -1e-3)) / 2e-3, 1e-8);
}

TEST(BoardSurface, APixelSeesItsPlaceAndTheTopOfABlock) {
  const Camera camera{640, 480, 900, 905, 330, 236, {-0.1}};
  const Rigid3 pose = testing::board_pose(kTarget, {3, 2, 450}, 25, -10, 30);
  const auto pixel = project(camera, pose * Vector3d(42, 17, 0));
  const auto place = seen_place(kTarget, camera, pose, *pixel);
  ASSERT_TRUE(place);
  EXPECT_LT((place->xy - Vector2d(42, 17)).norm(), 1e-6);
  // z points into the board: the top of a block lies at negative z.
  const auto above = project(camera, pose * Vector3d(42, 17, -20));
  const auto top = seen_place_on_top(camera, pose, 20, *above);
  ASSERT_TRUE(top);
  EXPECT_LT((top->point({0, 0}) - Vector3d(42, 17, -20)).norm(), 1e-6);
  EXPECT_LT((raised(pose, 20) * Vector3d(42, 17, 0) - pose * Vector3d(42, 17, -20)).norm(), 1e-9);
  const Plane touching = tangent_plane(*place, {0.3, 0.1}, pose);
  EXPECT_NEAR(touching.signed_distance(pose * place->point({0.3, 0.1})), 0, 1e-9);
}

}  // namespace
}  // namespace lightstripe
