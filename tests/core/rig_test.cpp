// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/rig.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

using Eigen::Vector3d;

TEST(RigRotation, RigAxesAreTravelUpAndTheirCross) {
  // Camera: x right, y down, z forward. Travel forward, up = -y: then y = z cross x = (-y) cross (+z) = -x,
  // to the left.
  const auto rig_from_camera = rig_rotation({0, 0, 2}, {0, -1, 0});
  EXPECT_LT((rig_from_camera * Vector3d(0, 0, 1) - Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((rig_from_camera * Vector3d(0, -1, 0) - Vector3d(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((rig_from_camera * Vector3d(-1, 0, 0) - Vector3d(0, 1, 0)).norm(), 1e-15);
}

TEST(RigRotation, UpHintIsMadeSquareToTheTravel) {
  const Vector3d travel = Vector3d(0.3, -0.2, 1).normalized(), hint(0.1, -1, -0.4);
  const Eigen::Matrix3d R = rig_rotation(travel, hint).toRotationMatrix();
  EXPECT_NEAR(R.determinant(), 1, 1e-14);
  EXPECT_LT((R * travel - Vector3d::UnitX()).norm(), 1e-14);
  const Vector3d up_rig = R * hint;
  EXPECT_NEAR(up_rig.y(), 0, 1e-14);  // the hint lies in the plane of x and z, on z's side
  EXPECT_GT(up_rig.z(), 0);
}

TEST(RigRotation, UpAlongTheTravelIsRefused) {
  EXPECT_THROW(rig_rotation({0, 0, 1}, {0, 0, -3}), std::logic_error);
}

}  // namespace
}  // namespace lightstripe
