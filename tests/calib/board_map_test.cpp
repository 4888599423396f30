// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_map.h"

#include <gtest/gtest.h>

#include "rendered_board.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using testing::board_pose;
using testing::true_corners;

const Camera kCamera{640, 480, 700, 700, 322, 238, {-0.25, 0.1}};
const Target kTarget{TargetType::kCheckerboard, 11, 8, 20, 20};

TEST(BoardMap, GivesPlacesBetweenTheCornersOfADistortedView) {
  const auto pose = board_pose(kTarget, {5, -5, 400}, 25, -15, 20);
  const auto map = fit_board_map(true_corners(kCamera, kTarget, pose), kTarget);
  ASSERT_TRUE(map);
  EXPECT_LT(map->rms_mm, 0.05);
  for (double x = -15; x < 215; x += 23)
    for (double y = -15; y < 155; y += 17) {
      const Vector2d pixel = project(kCamera, pose * Eigen::Vector3d(x, y, 0)).value();
      const bool inside = x >= 0 && x <= 200 && y >= 0 && y <= 140;
      EXPECT_LT(((*map)(pixel)-Vector2d(x, y)).norm(), inside ? 0.15 : 0.6) << x << ' ' << y;
      const Vector2d step(0.01, -0.02);
      const Vector2d numeric = ((*map)(pixel + step) - (*map)(pixel - step)) / 2;
      EXPECT_LT((map->derivative(pixel) * step - numeric).norm(), 1e-3 * numeric.norm());
    }
}

TEST(BoardMap, CornersOnALineGiveNone) {
  Target strip = kTarget;
  strip.rows = 1;
  const auto pose = board_pose(strip, {0, 0, 400}, 0, 0, 0);
  EXPECT_FALSE(fit_board_map(true_corners(kCamera, strip, pose), strip));
}

}  // namespace
}  // namespace lightstripe
