// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/session_views.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

Target board(int columns, int rows, double pitch_x = 10, double pitch_y = 10) {
  return {TargetType::kCheckerboard, columns, rows, pitch_x, pitch_y};
}

TEST(CornerOrders, OnlyBoardsThatLookTheSameMayBeTurned) {
  EXPECT_EQ(corner_orders(board(11, 8)).size(), 1u);
  EXPECT_EQ(corner_orders(board(11, 7)).size(), 2u);
  EXPECT_EQ(corner_orders(board(7, 7)).size(), 4u);
  EXPECT_EQ(corner_orders(board(7, 7, 10, 11)).size(), 2u);
}

TEST(CornerOrders, HalfTurnListsTheCornersBackwards) {
  const auto orders = corner_orders(board(4, 6));
  EXPECT_EQ(orders[1].front(), 23);
  EXPECT_EQ(orders[1].back(), 0);
}

TEST(BoardTurn, AgreesWithTheRelistedCorners) {
  for (const Target& target : {board(11, 7), board(7, 7), board(3, 5, 10, 12)}) {
    const auto orders = corner_orders(target);
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const Rigid3 old_from_new = board_turn(target, k);
      for (int i = 0; i < target.num_corners(); ++i) {
        const Eigen::Vector2d now = target.corner(i),
                              before = target.corner(orders[k][static_cast<std::size_t>(i)]);
        EXPECT_LT(
            (old_from_new * Eigen::Vector3d(now.x(), now.y(), 0) - Eigen::Vector3d(before.x(), before.y(), 0))
                .norm(),
            1e-9);
      }
    }
  }
}

TEST(IndependentPoints, LieAWidthApartAndAreMeasured) {
  std::vector<StripePoint> points(100);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x = static_cast<double>(i);
    points[i].width = 6;
  }
  points[12].flags = kStripeBridged;
  const auto kept = independent_points(points);
  EXPECT_EQ(kept.size(), 17u);  // 0 6 (13) 19 ... 97
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_GE(kept[i].x - kept[i - 1].x, 6);
}

}  // namespace
}  // namespace lightstripe
