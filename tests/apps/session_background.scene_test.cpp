// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A session whose board and laser are in one picture, with pictures of the laser off as its background.
#include <gmock/gmock.h>

#include <cmath>

#include "io/rig_file.h"
#include "rendered_session.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using testing::RenderedSession;

class SessionBackground : public ::testing::Test {
 protected:
  SessionBackground() {
    session_.poses = testing::well_spread_poses(session_.target);
    // A laser no brighter than the board's white: its line over black squares looks like one more of them.
    session_.look.laser_peak = 90;
    testing::write_pictures(session_, folder_.path(), "camera");
  }
  CommandResult calibrate(const std::string& sensor) const {
    write_text(
        folder_ / "session.yaml",
        "target: {type: checkerboard, inner_corners: [11, 8], square: 10}\nsensors:\n  - {name: camera, " +
            sensor + "}\ncalibration: {" + session_.calibration + "}\n");
    return testing::calibrate_in(folder_.path());
  }
  RenderedSession session_;
  TemporaryFolder folder_;
};

TEST_F(SessionBackground, GivesTheLaserPlaneFromPicturesOfBoardAndLaserTogether) {
  const CommandResult done = calibrate("board: camera/laser/*.png, background: camera/board/*.png");
  ASSERT_EQ(done.exit_code, 0) << done.err << done.out;
  EXPECT_THAT(done.out, HasSubstr("camera: 8 of 8 stripes lie in the laser plane"));
  const Plane found = read_rig(folder_ / "rig.yaml", RigUse::kCameras).sensors.at(0).laser_planes.at(0),
              truth = session_.lasers[0];
  EXPECT_GT(std::abs(found.normal.dot(truth.normal)), std::cos(0.1 * kDegree));
  const Eigen::Vector3d middle(0, 0, 500);  // the sheet crosses the line of sight there
  EXPECT_NEAR(found.signed_distance(middle), 0, 0.2);
}

TEST_F(SessionBackground, IsNoHelpWhenItIsOfAnotherExposure) {
  for (std::size_t i = 0; i < session_.poses.size(); ++i) {
    const auto file = folder_ / ("camera/board/" + std::to_string(i) + ".png");
    Image8 dark = read_image(file);
    for (auto& grey : dark.pixels) grey = static_cast<std::uint8_t>(grey / 4);
    write_image(file, dark);
  }
  const CommandResult done = calibrate("board: camera/laser/*.png, background: camera/board/*.png");
  EXPECT_NE(done.exit_code, 0);
  EXPECT_THAT(done.out + done.err, HasSubstr("as bright as its background"));
}

}  // namespace
}  // namespace lightstripe
