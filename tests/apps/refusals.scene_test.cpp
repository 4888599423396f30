// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Board pictures that cannot give a rig, through the command line: exit code 3, a sentence that names what is
// wrong and what to do, no rig.yaml.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "io/rig_file.h"
#include "rendered_session.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::board_pose;
using testing::calibrate_in;
using ::testing::HasSubstr;
using testing::RenderedSession;
using ::testing::StartsWith;

class Refusals : public ::testing::Test {
 protected:
  /// Of warnings and verdict, one line each, the verdict is the last.
  static std::string verdict_of(const CommandResult& result) {
    const auto end = result.err.find_last_not_of('\n') + 1, start = result.err.rfind('\n', end - 1) + 1;
    return result.err.substr(start, end - start);
  }

  void expect_refused(const std::string& what, const std::string& advice) {
    const auto result = calibrate_in(folder_.path());
    EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
    EXPECT_THAT(verdict_of(result), StartsWith("not usable: "));
    EXPECT_THAT(verdict_of(result), HasSubstr(what));
    EXPECT_THAT(verdict_of(result), HasSubstr(advice));
    EXPECT_FALSE(fs::exists(folder_ / "rig.yaml"));
  }

  void expect_refused(const RenderedSession& session, const std::string& what, const std::string& advice) {
    write_pictures(session, folder_.path(), "solo");
    write_session(session, folder_.path(), {"solo"});
    expect_refused(what, advice);
  }

  TemporaryFolder folder_;
};

RenderedSession well_spread() {
  RenderedSession session;
  session.poses = testing::well_spread_poses(session.target);
  return session;
}

/// Boards at different places and distances, tilted about x or y by that angle.
std::vector<Rigid3> poses_tilted_by(const RenderedSession& session, double tilt_deg) {
  std::vector<Rigid3> poses;
  for (int i = 0; i < 8; ++i)
    poses.push_back(board_pose(session.target, {10.0 * (i % 3) - 10, -4.0 * (i % 4), 480 + 6.0 * i},
                               tilt_deg * (i % 3 - 1), tilt_deg * (i % 2), 7.0 * i));
  return poses;
}

/// Boards whose stripe is always the line in which laser_at(0) meets the plane z = 500, turned about it.
std::vector<Rigid3> poses_about_one_line(const RenderedSession& session) {
  const Vector3d line = session.lasers[0].normal.cross(Vector3d::UnitZ()).normalized();
  const Vector3d through(0, 0, 500), middle(50, 35, 0);
  std::vector<Rigid3> poses;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd((i - 2.5) * 12 * kDegree, line));
    poses.push_back({q, through - q * middle});
  }
  return poses;
}

/// Boards a few degrees off the laser plane.
std::vector<Rigid3> poses_in_the_laser(const RenderedSession& session, double off_deg) {
  const Vector3d n = session.lasers[0].normal, line = n.cross(Vector3d::UnitZ()).normalized();
  const Vector3d middle(50, 35, 0);
  Random random(5);
  std::vector<Rigid3> poses;
  for (int i = 0; i < 8; ++i) {
    const Vector3d z = Eigen::AngleAxisd((off_deg + random.uniform(-1, 1)) * kDegree, line) * n;
    Eigen::Matrix3d R;
    R << line, z.cross(line), z;
    const Eigen::Quaterniond q = Eigen::Quaterniond(R) *
                                 Eigen::AngleAxisd(random.uniform(-0.3, 0.3), Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(random.uniform(-6, 6) * kDegree, Vector3d::UnitY());
    const Vector3d through =
        *intersect(session.lasers[0], Vector3d::Zero(),
                   Vector3d(random.uniform(-0.03, 0.03), random.uniform(-0.02, 0.02), 1));
    poses.push_back({q, through - q * middle});
  }
  return poses;
}

TEST_F(Refusals, AreNotForWellSpreadBoards) {
  const auto session = well_spread();
  write_pictures(session, folder_.path(), "solo");
  write_session(session, folder_.path(), {"solo"});
  const auto result = calibrate_in(folder_.path());
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const Rig rig = read_rig(folder_ / "rig.yaml");
  const double sigma_deg = rig.quality.sigma.at("solo.laser_planes.0.normal_deg");
  EXPECT_LT(std::asin(rig.sensors[0].laser_planes[0].normal.cross(session.lasers[0].normal).norm()) / kDegree,
            4 * sigma_deg);
  EXPECT_LT(sigma_deg, 0.3);
}

TEST_F(Refusals, TwoViews) {
  auto session = well_spread();
  session.poses.resize(2);
  expect_refused(session, "sensor solo: the board was found in 2 images only", "take 15 to 30");
}

TEST_F(Refusals, ASinglePose) {
  auto session = well_spread();
  session.poses.assign(6, session.poses[1]);
  expect_refused(session, "the board has the same pose in all views", "move");
}

TEST_F(Refusals, FrontoParallelBoardsOnly) {
  auto session = well_spread();
  session.poses = poses_tilted_by(session, 0);
  expect_refused(session, "parallel", "tilt the board");
}

TEST_F(Refusals, HardlyTiltedBoards) {
  auto session = well_spread();
  session.poses = poses_tilted_by(session, 2.5);
  expect_refused(session, "tilt", "tilt the board by 20 to 45 degrees");
}

TEST_F(Refusals, StripesThatAreOneLineInSpace) {
  auto session = well_spread();
  session.poses = poses_about_one_line(session);
  expect_refused(session, "all stripes lie on one line in space", "hold the board");
}

TEST_F(Refusals, BoardsInTheLaserPlane) {
  auto session = well_spread();
  session.look.laser_sigma_mm = 0.1;
  session.poses = poses_in_the_laser(session, 6);
  expect_refused(session, "the boards are nearly parallel to the laser plane",
                 "turn the board towards the camera");
}

TEST_F(Refusals, ACameraInTheLaserPlane) {
  auto session = well_spread();
  session.lasers = {{Vector3d(1, 0.02, 0).normalized(), 0.5}};
  expect_refused(session, "the camera lies in the laser plane", ";");
}

TEST_F(Refusals, SensorsThatShareNoPose) {
  const auto session = well_spread();
  write_pictures(session, folder_.path(), "gauge");
  for (const std::string kind : {"board", "laser"}) {
    fs::create_directories(folder_ / "field" / kind);
    for (std::size_t i = 0; i < session.poses.size(); ++i)
      fs::copy(folder_ / "gauge" / kind / fmt::format("{}.png", i),
               folder_ / "field" / kind / fmt::format("{}.png", i + 50));
  }
  write_session(session, folder_.path(), {"gauge", "field"});
  expect_refused("no board pose links sensor field with gauge", ";");
}

TEST_F(Refusals, AMeasuringRangeThatNoBoardReached) {
  auto session = well_spread();
  session.calibration += ", range_near_mm: 300, range_far_mm: 900";
  expect_refused(session, "the measuring range is 300 to 900 mm", "hold the board nearer and farther");
}

TEST_F(Refusals, ADistortionThatFolds) {
  // The radius in the picture is r - 0.45 r^3: largest, 0.574 f, at r = 0.86. With f = 320 px the picture's
  // corners lie 0.94 f from its middle, where this camera has no ray at all.
  auto session = well_spread();
  session.camera = {480, 360, 320, 320, 240, 180, {-0.45}};
  session.target.pitch_x = session.target.pitch_y = 16;
  session.poses = testing::well_spread_poses(session.target);
  expect_refused(session, "sensor solo: the distortion found cannot be inverted over the whole image",
                 "bring the board into the image's corners, or choose a leaner lens model");
}

}  // namespace
}  // namespace lightstripe
