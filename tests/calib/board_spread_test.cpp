// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How boards stand, of hand-made poses.
#include "calib/assess/board_spread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/adjust/session_views.h"
#include "calib/start/initial_values.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

TEST(BoardSpread, AnglesAndDepthsAreThoseOfTheBoards) {
  auto truth = testing::rail_rig(1, 6);
  truth.sensors[0].camera.distortion[4] = 0;
  const testing::SessionOptions options{.poses = 10, .travel_steps = 0, .seed = 6};
  const auto seen = testing::observe(truth, options);
  const InitialValues start = initial_values(prepare_session_views(seen));
  CalibrationOptions calibration;
  calibration.board_warp = false;
  const auto adjustment = adjust_jointly(start.session, start.state, {LensModel::kBrown4}, calibration);
  const BoardSpread spread = board_spread(start.session, adjustment, 0);

  const auto boards = testing::board_poses(truth, options);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double near = 1e9, far = 0;
  for (const auto& board : boards) mean += board.rotation * Eigen::Vector3d::UnitZ();
  double tilt = 0;
  std::vector<double> to_laser;
  for (std::size_t i = 0; i < boards.size(); ++i) {
    const Eigen::Vector3d normal = boards[i].rotation * Eigen::Vector3d::UnitZ();
    tilt = std::max(tilt, std::acos(normal.dot(mean.normalized())) / kDegree);
    if (seen.sensors[0].views[i].stripes[0].size() > 10)
      to_laser.push_back(std::acos(std::abs(normal.dot(truth.sensors[0].laser_planes[0].normal))) / kDegree);
    for (const auto& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(100, 70, 0), Eigen::Vector3d(100, 0, 0),
                          Eigen::Vector3d(0, 70, 0)}) {
      near = std::min(near, (boards[i] * p).z());
      far = std::max(far, (boards[i] * p).z());
    }
  }
  EXPECT_THAT(spread.laser_angles_deg.at(0), Pointwise(DoubleNear(0.5), to_laser));
  EXPECT_NEAR(spread.tilt_deg, tilt, 0.5);
  EXPECT_GT(spread.stripe_depths.near_mm, near - 20);  // stripes reach a square beyond the corners
  EXPECT_LT(spread.stripe_depths.far_mm, far + 20);
  EXPECT_GT(spread.stripe_depths.far_mm, spread.stripe_depths.near_mm + 20);
  EXPECT_GT(spread.stripe_coverage, 0.2);
  EXPECT_LE(spread.stripe_coverage, 1);
}

}  // namespace
}  // namespace lightstripe
