// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The rig frame of hand-made states.
#include "calib/adjust/rig_frame.h"

#include <gtest/gtest.h>

#include "core/rig.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

RigState state_travelling(const Vector3d& direction) {
  RigState state;
  state.sensors.push_back({{}, {}, {{Vector3d(0, 0.6, 0.8), 400}}});
  state.motion = MotionState{{}, direction, Vector3d::Zero()};
  return state;
}

TEST(RigFrame, XIsTheTravelAndZIsUpSquareToIt) {
  const Rigid3 frame =
      rig_from_first(state_travelling({0, 0.6, 0.8}), MotionType::kLinear, Vector3d(0, -1, 0));
  EXPECT_LT((frame * Vector3d(0, 0.6, 0.8) - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((frame * Vector3d(0, -0.8, 0.6) - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((frame * Vector3d(-1, 0, 0) - Vector3d::UnitY()).norm(), 1e-12);  // right-handed: z cross x
  EXPECT_EQ(frame.translation.norm(), 0);
}

TEST(RigFrame, WithoutATravelXIsTheFirstLaserPlanesNormal) {
  RigState state = state_travelling(Vector3d::UnitX());
  state.motion.reset();
  const Rigid3 frame = rig_from_first(state, MotionType::kNone, Vector3d(0, -1, 0));
  EXPECT_LT((frame * Vector3d(0, 0.6, 0.8) - Vector3d::UnitX()).norm(), 1e-12);
}

TEST(RigFrame, UpAlongTheTravelIsRefused) {
  EXPECT_THROW(rig_from_first(state_travelling({0, 1, 0.01}), MotionType::kLinear, Vector3d(0, -1, 0)),
               NotUsable);
}

TEST(RigFrame, TheAxisIsNamedByItsPointNearestToTheCamera) {
  const MotionState motion{{}, Vector3d(0, 0, 2), Vector3d(3, 4, 500)};
  EXPECT_LT((nearest_point_of_axis(motion) - Vector3d(3, 4, 0)).norm(), 1e-12);
}

TEST(RigFrame, ATurnedAxisTurnsTheSense) {
  RigState state = state_travelling({0, 0, -1});
  SessionViews session;
  session.sensor_names = {"solo"};
  session.motion = MotionType::kRotary;
  session.moves = Moves::kRig;
  // The frame's x is the laser's normal, so that the axis is not along it; its y component decides.
  const Rig rig = rig_of(session, state, Vector3d(0, -1, 0));
  EXPECT_GE(rig.motion.axis_direction.y(), 0);
  const Vector3d axis = rig.sensors[0].rig_from_camera.rotation * Vector3d(0, 0, -1);
  const bool turned = axis.dot(rig.motion.axis_direction) < 0;
  EXPECT_EQ(rig.motion.moves, turned ? Moves::kObject : Moves::kRig);
}

}  // namespace
}  // namespace lightstripe
