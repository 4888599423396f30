// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/rig_state.h"

#include <gtest/gtest.h>

#include "calib/adjust/joint_problem.h"
#include "calib/adjust/rig_frame.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

TEST(StripeLine, IsWhereThePlanesMeet) {
  const auto line = stripe_line({Vector3d::UnitZ(), 500}, {Vector3d::UnitY(), 20});
  ASSERT_TRUE(line);
  EXPECT_LT((line->point - Vector3d(0, 20, 500)).norm(), 1e-12);
  EXPECT_NEAR(std::abs(line->direction.x()), 1, 1e-12);
}

TEST(StripeLine, DoesNotExistForParallelPlanes) {
  EXPECT_FALSE(stripe_line({Vector3d::UnitZ(), 500}, {Vector3d(0, 0.005, 1).normalized(), 400}));
}

RigState one_sensor() {
  RigState state;
  const Vector3d n = Vector3d(0, 0.8, 0.6);
  state.sensors.push_back({{960, 700, 1600, 1600, 480, 350, {}}, {}, {{n, 330}}});
  return state;
}

TEST(RigFromFirst, TakesTheDirectionOfTravelAsX) {
  auto state = one_sensor();
  state.motion.emplace();
  state.motion->direction = Vector3d(0, 0.6, 0.8);
  const Rigid3 rig = rig_from_first(state, MotionType::kLinear, {0, -1, 0});
  EXPECT_LT((rig.rotation * Vector3d(0, 0.6, 0.8) - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_GT((rig.rotation * Vector3d(0, -1, 0)).z(), 0.7);
  EXPECT_NEAR((rig.rotation * Vector3d(0, -1, 0)).y(), 0, 1e-12);
  EXPECT_EQ(rig.translation.norm(), 0);
}

TEST(RigFromFirst, WithoutMotionTakesTheLaserPlanesNormal) {
  const Rigid3 rig = rig_from_first(one_sensor(), MotionType::kNone, {0, -1, 0});
  EXPECT_LT((rig.rotation * Vector3d(0, 0.8, 0.6) - Vector3d::UnitX()).norm(), 1e-12);
}

TEST(RigFromFirst, RefusesAnUpHintAlongX) {
  EXPECT_THROW(rig_from_first(one_sensor(), MotionType::kNone, {0, 0.8, 0.6}), NotUsable);
}

TEST(RigOf, TurnsARotaryAxisToGrowWithY) {
  SessionViews session;
  session.sensor_names = {"only"};
  session.motion = MotionType::kRotary;
  auto state = one_sensor();
  state.motion.emplace();
  for (const double sign : {1.0, -1.0}) {
    state.motion->direction = sign * Vector3d::UnitX();
    const Rig rig = rig_of(session, state, {0, -1, 0});
    EXPECT_GT(rig.motion.axis_direction.y(), 0.99);
    // Camera x is -y of the rig here (y = z cross x), so the axis along +x is turned, and with it the sense.
    EXPECT_EQ(rig.motion.moves == Moves::kRig,
              rig.sensors[0].rig_from_camera.rotation.toRotationMatrix()(1, 0) * sign > 0);
  }
}

TEST(MovedState, MovesTheUnknownThatTheColumnNames) {
  using Kind = GlobalBlock::Kind;
  const auto state = one_sensor();
  const std::vector<GlobalBlock> globals{{Kind::kIntrinsics, 0, 0, 0, 9, LensModel::kBrown5},
                                         {Kind::kLaserPlane, 0, 0, 9, 3}};
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(12);
  delta[0] = 2;     // fx
  delta[5] = 0.01;  // k2
  delta[11] = 0.5;  // the plane's offset
  const auto after = moved_state(state, globals, delta);
  EXPECT_EQ(after.sensors[0].camera.fx, 1602);
  EXPECT_EQ(after.sensors[0].camera.fy, 1600);
  EXPECT_EQ(after.sensors[0].camera.distortion[1], 0.01);
  EXPECT_NEAR(after.sensors[0].laser_planes[0].offset, 330.5, 1e-12);
  EXPECT_LT((after.sensors[0].laser_planes[0].normal - Vector3d(0, 0.8, 0.6)).norm(), 1e-12);
}

}  // namespace
}  // namespace lightstripe
