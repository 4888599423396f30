// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The stereo pictures of Debian's opencv-doc: intrinsics against those that come with them, and left and
// right as one rig.
#include <gtest/gtest.h>

#include <filesystem>

#include "calib/board/observe_board.h"
#include "calib/calibrate_rig.h"
#include "io/camera_file.h"
#include "io/images.h"

namespace lightstripe {
namespace {

const std::filesystem::path kData = "/usr/share/doc/opencv-doc/examples/data";

#define SKIP_WITHOUT_DATA() \
  if (!std::filesystem::exists(kData / "left01.jpg")) GTEST_SKIP() << "no opencv-doc in " << kData

SensorObservations observe(const std::string& name, const Target& target) {
  SensorObservations sensor{name, 640, 480, 0, {}, {}};
  for (const auto& path : list_files(kData, name + "??.jpg")) {
    const auto board = detect_board(read_image(path, Channel::kGray).view(), target);
    const std::string file = path.filename().string();
    if (board.found) sensor.views.push_back({file, matched_text(name + "*.jpg", path), board.corners, {}});
  }
  return sensor;
}

CalibrationObservations observe_both() {
  CalibrationObservations observations;
  observations.target = {TargetType::kCheckerboard, 9, 6, 25, 25};
  for (const std::string name : {"left", "right"})
    observations.sensors.push_back(observe(name, observations.target));
  return observations;
}

/// The boards are held by hand: paper on a plate.
CalibrationOptions with_warp() {
  CalibrationOptions options;
  options.board_warp = true;
  return options;
}

TEST(OpenCvBoards, IntrinsicsAreThoseThatComeWithThePictures) {
  SKIP_WITHOUT_DATA();
  const auto both = observe_both();
  EXPECT_EQ(both.sensors[0].views.size(), 13u);
  EXPECT_GE(both.sensors[1].views.size(), 12u);
  const Camera left = read_camera_file((kData / "left_intrinsics.yml").string());
  CalibrationObservations alone = both;
  alone.sensors.resize(1);
  const auto result = calibrate_rig(alone, with_warp());
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  const Camera& found = result.rig.sensors[0].camera;
  EXPECT_NEAR(found.fx, left.fx, 0.005 * left.fx);
  EXPECT_NEAR(found.fy, left.fy, 0.005 * left.fy);
  EXPECT_NEAR(found.cx, left.cx, 0.005 * left.width);
  EXPECT_NEAR(found.cy, left.cy, 0.005 * left.width);
  EXPECT_LT(result.rig.quality.sensors[0].board_rms_px, 0.39);  // what OpenCV's file says of itself
}

TEST(OpenCvBoards, LeftAndRightAreOneRig) {
  SKIP_WITHOUT_DATA();
  const auto result = calibrate_rig(observe_both(), with_warp());
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  const Camera left = read_camera_file((kData / "left_intrinsics.yml").string());
  EXPECT_NEAR(result.rig.sensors[0].camera.fx, left.fx, 0.005 * left.fx);
  // Two cameras side by side: about 83 mm apart by OpenCV's own stereo calibration, turned by less than a
  // degree.
  const Rigid3 left_from_right =
      result.rig.sensors[0].rig_from_camera.inverse() * result.rig.sensors[1].rig_from_camera;
  EXPECT_NEAR(left_from_right.translation.x(), 83.3, 1);
  EXPECT_LT(left_from_right.translation.tail<2>().norm(), 2);
  EXPECT_LT(rotation_angle(left_from_right.rotation) * 57.3, 1.5);
}

TEST(OpenCvBoards, AreNotFoundAsBoardsOfAnotherSize) {
  SKIP_WITHOUT_DATA();
  // 9 x 7: four of the pictures once were, with the outer edge of the squares as a row; 8 x 5: two.
  for (const auto& [columns, rows] : {std::pair{9, 7}, {8, 5}, {10, 7}, {7, 7}}) {
    const Target wrong{TargetType::kCheckerboard, columns, rows, 25, 25};
    EXPECT_TRUE(observe("left", wrong).views.empty()) << columns << " x " << rows;
  }
}

}  // namespace
}  // namespace lightstripe
