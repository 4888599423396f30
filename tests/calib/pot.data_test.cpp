// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The real board pictures of shared/data/pot: board and red line in one colour picture.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "calib/board/observe_board.h"
#include "calib/calibrate_rig.h"
#include "io/images.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

const std::filesystem::path kPot = LIGHTSTRIPE_SOURCE_DIR "/../shared/data/pot/board";

/// The red line hardly shows in green.
CalibrationObservations observe_pot() {
  CalibrationObservations observations;
  observations.target = {TargetType::kCheckerboard, 11, 7, 21.167, 21.125};
  SensorObservations sensor{"pot", 1152, 768, 1, {}};
  for (const auto& path : list_files(kPot, "*.png")) {
    const Image8 green = read_image(path, Channel::kGreen);
    const auto board = detect_board(green.view(), observations.target);
    if (!board.found) continue;
    const Image8 line = read_image(path, Channel::kRedExcess);
    const auto stripe = find_stripe_on_board(line, {}, board.corners, observations.target, 1, {});
    const std::string name = path.filename().string();
    sensor.views.push_back({name, name, board.corners, stripe.planes});
  }
  observations.sensors.push_back(sensor);
  return observations;
}

TEST(Pot, CalibratesFromRealPictures) {
  if (!std::filesystem::exists(kPot)) GTEST_SKIP() << "no data in " << kPot;
  const auto observations = observe_pot();
  EXPECT_GE(observations.sensors[0].views.size(), 13u);
  // Both references took the board as flat, and so does this comparison.
  CalibrationOptions flat;
  flat.board_warp = false;
  const auto result = calibrate_rig(observations, flat);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_LE(result.rig.quality.sensors[0].board_rms_px, 0.25);
  EXPECT_LE(result.rig.quality.sensors[0].stripe_rms_px, 0.25);
  // An independent centroid fit of the same pictures, its normal turned to d > 0.
  const Plane& plane = result.rig.sensors[0].laser_planes[0];
  const Eigen::Vector3d reference = Eigen::Vector3d(-0.8758, -0.3479, 0.3347).normalized();
  EXPECT_LT(std::acos(plane.normal.dot(reference)) * 180 / std::numbers::pi, 0.3);
  EXPECT_NEAR(plane.offset, 122.78, 1);
}

TEST(Pot, TheBoardIsBowedAndTheCornersFitBetterWithIt) {
  if (!std::filesystem::exists(kPot)) GTEST_SKIP() << "no data in " << kPot;
  const auto observations = observe_pot();
  CalibrationOptions options;
  options.board_warp = true;
  const auto result = calibrate_rig(observations, options);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  // 0.199 px with a flat board, 0.166 px with one that is bowed by 0.37 mm over its 212 mm; the laser plane
  // then differs by 0.36 degrees from the reference above.
  EXPECT_LT(result.rig.quality.sensors[0].board_rms_px, 0.18);
  EXPECT_NEAR(result.summary.board_warp_mm.x(), -0.37, 0.1);
  EXPECT_NEAR(result.rig.sensors[0].laser_planes[0].offset, 122.78, 1);
}

TEST(Pot, EveryChannelShowsTheBoards) {
  if (!std::filesystem::exists(kPot)) GTEST_SKIP() << "no data in " << kPot;
  const Target target{TargetType::kCheckerboard, 11, 7, 21.167, 21.125};
  for (const auto channel : {Channel::kGray, Channel::kRed, Channel::kGreen, Channel::kBlue}) {
    int found = 0;
    for (const auto& path : list_files(kPot, "*.png"))
      found += detect_board(read_image(path, channel).view(), target).found;
    EXPECT_GE(found, 13) << enum_name(channel);
  }
}

}  // namespace
}  // namespace lightstripe
