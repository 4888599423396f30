// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What calibrate_rig() refuses, and in which words: synthetic observations of rail rigs, each with one fault.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/adjust/session_views.h"
#include "calib/calibrate_rig.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using testing::calibrate_with_warp;
using ::testing::HasSubstr;
using testing::noisy;
using ::testing::Not;
using testing::observe;
using testing::perfect;
using testing::rail_rig;
using testing::SyntheticRig;

/// Expects a refusal whose sentence holds `text`.
void expect_refusal(const CalibrationObservations& observations, const std::string& text) {
  const auto result = calibrate_with_warp(observations);
  EXPECT_FALSE(result.summary.usable);
  EXPECT_THAT(result.summary.message, HasSubstr(text));
  EXPECT_THAT(result.summary.message, HasSubstr(";")) << "says what to do";
}

TEST(CalibrateRigRefuses, TooFewViews) {
  expect_refusal(observe(rail_rig(), perfect(2)), "sensor gauge: the board was found in 2 images only");
}

TEST(CalibrateRigRefuses, SensorsWithoutACommonPose) {
  auto observations = observe(rail_rig(), perfect(8));
  for (auto& view : observations.sensors[1].views) view.pose = "other_" + view.pose;
  expect_refusal(observations, "no board pose links sensor field with gauge");
}

TEST(CalibrateRigRefuses, ParallelBoards) {
  auto options = perfect(8);
  options.max_tilt_deg = 0;
  expect_refusal(observe(rail_rig(), options), "all boards are parallel");
}

TEST(CalibrateRigRefuses, HardlyTiltedBoards) {
  auto options = noisy(12);
  options.max_tilt_deg = 3;
  expect_refusal(observe(rail_rig(1), options), "the boards are tilted by");
}

TEST(CalibrateRigRefuses, TooFewNoisyViewsForTheSection) {
  auto options = noisy(4);
  options.max_tilt_deg = 8;
  options.corner_noise_px = 1;
  expect_refusal(observe(rail_rig(1), options), "the shape of a section would be uncertain");
}

TEST(CalibrateRigRefuses, NoStripe) {
  auto observations = observe(rail_rig(), perfect(6));
  for (auto& view : observations.sensors[0].views) view.stripes.clear();
  expect_refusal(observations, "sensor gauge: the stripe was found on 0 boards only");
}

TEST(CalibrateRigRefuses, StripesThatAreOneLineInSpace) {
  // The boards turn about a line of the laser plane: every stripe is that line.
  const auto truth = rail_rig(1);
  auto observations = observe(truth, perfect(6));
  observations.motion.reset();
  const auto& sensor = truth.sensors[0];
  const Vector3d line = sensor.laser_planes[0].normal.cross(Vector3d::UnitZ()).normalized();
  const Vector3d through = *intersect(sensor.laser_planes[0], Vector3d::Zero(), Vector3d::UnitZ());
  const Vector3d middle(50, 35, 0);
  for (int i = 0; i < 6; ++i) {
    auto& view = observations.sensors[0].views[static_cast<std::size_t>(i)];
    const Eigen::Quaterniond q(Eigen::AngleAxisd((i - 2.5) * 12 * kDegree, line));
    const Rigid3 cam_from_board{q, through - q * middle};
    view.corners = testing::seen_corners(truth.target, sensor.camera, cam_from_board);
    view.stripes = {testing::seen_stripe(truth.target, sensor, cam_from_board, 6)};
  }
  expect_refusal(observations, "all stripes lie on one line in space");
}

TEST(CalibrateRigRefuses, ALaserThroughTheCamera) {
  auto truth = rail_rig(1);
  truth.sensors[0].laser_planes[0] = {Vector3d(1, 0.02, 0).normalized(), 0.5};
  auto observations = observe(truth, perfect(8));
  observations.motion.reset();
  expect_refusal(observations, "the camera lies in the laser plane");
}

TEST(CalibrateRigRefuses, ASinglePose) {
  auto observations = observe(rail_rig(1), perfect(6));
  for (auto& view : observations.sensors[0].views) {
    view.corners = observations.sensors[0].views[0].corners;
    view.stripes = observations.sensors[0].views[0].stripes;
  }
  expect_refusal(observations, "the board has the same pose in all views");
}

/// A one-sensor session of boards that are turned by `turn` degrees out of the laser plane, about the stripe,
/// and a few degrees about other axes.
CalibrationObservations boards_near_the_laser_plane(const SyntheticRig& truth, double turn) {
  auto observations = observe(truth, perfect(10));
  observations.motion.reset();
  const auto& sensor = truth.sensors[0];
  const Vector3d n = sensor.laser_planes[0].normal;
  const Vector3d line = n.cross(Vector3d::UnitZ()).normalized();
  const Vector3d middle(50, 35, 0);
  Random random(5);
  for (auto& view : observations.sensors[0].views) {
    const Vector3d z = Eigen::AngleAxisd((turn + random.uniform(-3, 3)) * kDegree, line) * n;
    Eigen::Matrix3d R;
    R << line, z.cross(line), z;
    const Eigen::Quaterniond q = Eigen::Quaterniond(R) *
                                 Eigen::AngleAxisd(random.uniform(-0.3, 0.3), Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(random.uniform(-8, 8) * kDegree, Vector3d::UnitY());
    const Vector3d through =
        *intersect(sensor.laser_planes[0], Vector3d::Zero(),
                   Vector3d(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), 1));
    const Rigid3 cam_from_board{q, through - q * middle};
    view.corners = testing::seen_corners(truth.target, sensor.camera, cam_from_board);
    view.stripes = {testing::seen_stripe(truth.target, sensor, cam_from_board, 6)};
  }
  return observations;
}

TEST(CalibrateRigRefuses, BoardsParallelToTheLaserPlane) {
  const auto truth = rail_rig(1);
  expect_refusal(boards_near_the_laser_plane(truth, 5), "the boards are nearly parallel to the laser plane");
  const auto result = calibrate_with_warp(boards_near_the_laser_plane(truth, 30));
  EXPECT_THAT(result.summary.message, Not(HasSubstr("parallel to the laser plane")));
}

TEST(CalibrateRigRefuses, StripesInACornerOfTheImage) {
  // What is left of each stripe lies in a window of 50 x 50 px.
  auto observations = observe(rail_rig(1), noisy(20));
  for (auto& view : observations.sensors[0].views)
    std::erase_if(view.stripes[0],
                  [](const StripePoint& p) { return std::hypot(p.x - 480, p.y - 350) > 50; });
  expect_refusal(observations, "all else would be extrapolated");
}

TEST(CalibrateRigRefuses, AMeasuringRangeThatNoBoardReached) {
  const auto observations = observe(rail_rig(), noisy(12));
  CalibrationOptions options;
  options.board_warp = true;
  options.range_near_mm = 300;
  options.range_far_mm = 900;
  const auto result = calibrate_rig(observations, options);
  EXPECT_FALSE(result.summary.usable);
  EXPECT_THAT(result.summary.message,
              HasSubstr("the measuring range is 300 to 900 mm; hold the board nearer"));
  options.range_near_mm = 510;
  options.range_far_mm = 590;
  EXPECT_TRUE(calibrate_rig(observations, options).summary.usable);
}

TEST(CalibrateRigRefuses, AMotionThatStandsStill) {
  auto options = perfect(6);
  options.travel_mm = 0;
  expect_refusal(observe(rail_rig(), options), "all images of the fixed board have the same travel");
}

TEST(CalibrateRigRefuses, TravelThatTheCameraDoesNotSee) {
  auto observations = observe(rail_rig(), perfect(6));
  for (auto& travel : observations.motion->travel) travel *= 10;
  expect_refusal(observations, "the board moved 0.10 mm in the camera for each mm of travel");
}

TEST(CalibrateRigRefuses, UpAlongTheTravel) {
  const auto truth = rail_rig();
  auto observations = observe(truth, perfect(6));
  observations.up = truth.direction;
  expect_refusal(observations, "up: the hint is parallel to the direction of travel");
}

TEST(CalibrateRigRefuses, ABoardOfAnotherShape) {
  auto observations = observe(rail_rig(), perfect(8));
  observations.target.pitch_y *= 1.08;
  EXPECT_FALSE(calibrate_with_warp(observations).summary.usable);
}

}  // namespace
}  // namespace lightstripe
