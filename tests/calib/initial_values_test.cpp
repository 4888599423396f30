// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Each stage of the start values against the known rig, before any adjustment.
#include "calib/start/initial_values.h"

#include <gtest/gtest.h>

#include "calib/adjust/session_views.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

struct Start {
  testing::SyntheticRig truth = testing::rail_rig(2, 8);
  InitialValues values;

  Start() {
    for (auto& sensor : truth.sensors) sensor.camera.distortion[4] = 0;
    values = initial_values(prepare_session_views(testing::observe(truth, {.poses = 14, .seed = 8})));
  }
};

TEST(StartCameras, FocalLengthWithinAPercentAndBoardsInPlace) {
  const Start start;
  ASSERT_EQ(start.values.state.sensors.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    const Camera &found = start.values.state.sensors[s].camera, &known = start.truth.sensors[s].camera;
    EXPECT_NEAR(found.fx, known.fx, 0.01 * known.fx);
    EXPECT_NEAR(found.cx, known.cx, 15);
  }
  const auto boards = testing::board_poses(start.truth, {.poses = 14, .seed = 8});
  EXPECT_LT((start.values.state.first_from_board[3].translation - boards[3].translation).norm(), 8);
}

TEST(LinkSensors, TheSecondCameraStandsWhereItIs) {
  const Start start;
  const Rigid3 error =
      start.values.state.sensors[1].cam_from_first * start.truth.sensors[1].cam_from_first.inverse();
  EXPECT_LT(rotation_angle(error.rotation) / kDegree, 0.5);
  EXPECT_LT(error.translation.norm(), 8);
}

TEST(StartLaserPlanes, WithinAFewTenthsOfADegree) {
  const Start start;
  for (std::size_t s = 0; s < 2; ++s) {
    const Plane &found = start.values.state.sensors[s].laser_planes.at(0),
                &known = start.truth.sensors[s].laser_planes[0];
    EXPECT_LT(std::asin(found.normal.cross(known.normal).norm()) / kDegree, 0.5);
    EXPECT_NEAR(found.offset, known.offset, 6);
  }
}

TEST(StartMotion, TheDirectionOfTravel) {
  const Start start;
  ASSERT_TRUE(start.values.state.motion);
  const auto& found = start.values.state.motion->direction;
  EXPECT_LT(std::asin(found.cross(start.truth.direction).norm()) / kDegree, 0.6);
  EXPECT_GT(found.dot(start.truth.direction), 0);
}

TEST(KeepViews, KeepsPosesBesideTheirViews) {
  Start start;
  InitialValues& values = start.values;
  std::vector<bool> keep(values.session.views.size(), false);
  keep[2] = keep[5] = true;
  const std::string image = values.session.views[5].image;
  const Rigid3 pose = values.cam_from_board[5];
  keep_views(values, keep);
  ASSERT_EQ(values.session.views.size(), 2u);
  EXPECT_EQ(values.session.views[1].image, image);
  EXPECT_EQ((values.cam_from_board[1].translation - pose.translation).norm(), 0);
}

}  // namespace
}  // namespace lightstripe
