// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/uncertainty.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

TEST(WithoutRigidMotion, TakesOutShiftsAndTurnsOnly) {
  Eigen::VectorXd section(8), shift(8), turn(8), stretch(8);
  section << 0, 0, 10, 0, 10, 10, 0, 10;
  shift << 3, -2, 3, -2, 3, -2, 3, -2;
  turn << 5, -5, 5, 5, -5, 5, -5, -5;  // (-(y - 5), x - 5) of the points
  turn *= -1;
  stretch << -5, -5, 5, -5, 5, 5, -5, 5;
  EXPECT_LT(without_rigid_motion(section, shift).norm(), 1e-12);
  EXPECT_LT(without_rigid_motion(section, turn).norm(), 1e-12);
  EXPECT_LT((without_rigid_motion(section, stretch) - stretch).norm(), 1e-12);
  EXPECT_LT((without_rigid_motion(section, turn, kShifts) - turn).norm(), 1e-12);
  EXPECT_LT(
      (without_rigid_motion(section, shift, kShiftAlong) - Eigen::Vector2d(0, -2).replicate(4, 1)).norm(),
      1e-12);
}

}  // namespace
}  // namespace lightstripe
