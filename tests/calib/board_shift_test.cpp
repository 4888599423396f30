// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_shift.h"

#include <gtest/gtest.h>

#include "rendered_board.h"

namespace lightstripe {
namespace {

using testing::board_pose;
using testing::BoardLook;
using testing::render_board;
using testing::true_corners;

const Camera kCamera{480, 360, 825, 824, 242, 178, {}};
const Target kTarget{TargetType::kCheckerboard, 11, 8, 10, 10};

/// Shift as found where the board of the laser picture stands `right_mm` beside that of the other.
std::optional<double> shift(double right_mm, const BoardLook& laser_look) {
  const auto pose = board_pose(kTarget, {0, 0, 500}, 15, -20, 10);
  const auto moved = board_pose(kTarget, {right_mm, 0, 500}, 15, -20, 10);
  return board_shift_px(render_board(kCamera, kTarget, moved, laser_look, 2).view(),
                        render_board(kCamera, kTarget, pose, {}, 1).view(),
                        true_corners(kCamera, kTarget, pose), kTarget);
}

TEST(BoardShift, ABoardThatStoodStillIsSeenToDoSo) {
  const auto found = shift(0, {.ambient = 0.3});
  ASSERT_TRUE(found);
  EXPECT_LT(*found, 0.3);
}

TEST(BoardShift, ABoardThatMovedIsSeenToDoSo) {
  // 2 mm at half a metre: 3.3 px.
  const auto found = shift(2, {.ambient = 0.3});
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 3.3, 0.5);
}

TEST(BoardShift, InTheDarkNothingIsSaid) { EXPECT_FALSE(shift(2, {.dark = 5, .light = 5, .background = 5})); }

}  // namespace
}  // namespace lightstripe
