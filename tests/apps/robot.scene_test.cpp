// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A rig on a robot's tool: calibrated from boards with the tool's poses, then a scan that takes the tool's
// poses lies in the robot's base frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "io/rig_file.h"
#include "reconstruct/cloud.h"
#include "rendered_session.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using testing::calibrate_in;
using testing::RenderedSession;

const Rigid3 kToolFromFirst{Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d(1, 2, -1).normalized())),
                            {80, -30, 120}};
const Rigid3 kBaseFromBoard{Eigen::Quaterniond(Eigen::AngleAxisd(2.8, Vector3d(1, 0.1, 0).normalized())),
                            {600, 100, 50}};

/// What the controller says where the tool really is there: 0.01 degrees and 0.03 mm off, each component.
Rigid3 as_reported(const Rigid3& base_from_tool, Random& random) {
  const auto noise = [&](double sigma) {
    return Vector3d(sigma * random.gaussian(), sigma * random.gaussian(), sigma * random.gaussian());
  };
  const Vector3d turn = noise(0.01 * kDegree);
  return base_from_tool *
         Rigid3{Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())), noise(0.03)};
}

std::string row_of(const std::string& name, const Rigid3& pose) {
  const auto& q = pose.rotation;
  const auto& t = pose.translation;
  return fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.5f},{:.5f},{:.5f}\n", name, q.w(), q.x(), q.y(),
                     q.z(), t.x(), t.y(), t.z());
}

/// Boards 500 mm away, tilted and turned more than a board on a table: the tool's turns tell where it sits.
std::vector<Rigid3> many_poses(const Target& target) {
  auto poses = testing::well_spread_poses(target);
  const double more[][5]{{20, 20, 60, 5, 10},   {-18, 25, -60, -5, -10}, {25, -15, 90, 0, 5},
                         {-25, -20, 35, 5, -5}, {15, 30, -35, -8, 15},   {-30, 12, 120, 4, -12}};
  for (const auto& t : more)
    poses.push_back(testing::board_pose(target, {t[3], -0.8 * t[4], 500 + t[4]}, t[0], t[1], t[2]));
  return poses;
}

TEST(RigOnARobot, ItsScanLiesInTheRobotsBase) {
  const TemporaryFolder folder;
  RenderedSession session;
  session.poses = many_poses(session.target);
  write_pictures(session, folder.path(), "solo");
  Random random(11);
  std::string table = "image,qw,qx,qy,qz,x,y,z\n";
  for (std::size_t i = 0; i < session.poses.size(); ++i)
    table +=
        row_of(fmt::format("{}.png", i),
               as_reported(kBaseFromBoard * session.poses[i].inverse() * kToolFromFirst.inverse(), random));
  write_text(folder / "poses.csv", table);
  write_text(folder / "session.yaml",
             "target: {type: checkerboard, inner_corners: [11, 8], square: 10}\n"
             "sensors: [{name: solo, board: solo/board/*.png, laser: solo/laser/*.png}]\n"
             "motion: {type: poses, file: poses.csv}\ncalibration: {lens: brown4, board_warp: true}\n");
  const auto calibrated = calibrate_in(folder.path());
  ASSERT_EQ(calibrated.exit_code, 0) << calibrated.out << calibrated.err;

  const Rig rig = read_rig(folder / "rig.yaml");
  ASSERT_TRUE(rig.tool_from_rig);
  const Rigid3 off = *rig.tool_from_rig * rig.sensors[0].rig_from_camera * kToolFromFirst.inverse();
  const auto& sigma = rig.quality.sigma;
  EXPECT_LT(Eigen::AngleAxisd(off.rotation).angle() / kDegree, 3 * sigma.at("tool.rotation_deg"));
  EXPECT_LT((rig.tool_from_rig->translation - kToolFromFirst.translation).norm(),
            3 * sigma.at("tool.translation_mm"));
  EXPECT_LT(sigma.at("tool.translation_mm"), 2);

  // A plate in the base's frame, seen from six places of the tool.
  const Rigid3 base_from_plate = kBaseFromBoard * Rigid3{Eigen::Quaterniond::Identity(), {20, 10, -40}};
  const Target plate{TargetType::kCheckerboard, 3, 3, 30, 30};
  const testing::BoardLook white = testing::lit_plate(20, 170);
  table = "frame,qw,qx,qy,qz,x,y,z\n";
  for (int i = 0; i < 6; ++i) {
    const Rigid3 first_from_plate = testing::board_pose(plate, {0, 12.0 * (i - 2.5), 495 + 3.0 * i},
                                                        8.0 * i - 20, 15 - 6.0 * i, 20.0 * i);
    write_image(folder / fmt::format("scan/{}.png", i),
                render_board(session.camera, plate, first_from_plate, white,
                             50 + static_cast<std::uint64_t>(i), session.lasers));
    table +=
        row_of(std::to_string(i),
               as_reported(base_from_plate * first_from_plate.inverse() * kToolFromFirst.inverse(), random));
  }
  write_text(folder / "tool.csv", table);
  write_text(folder / "scan.yaml",
             "rig: rig.yaml\nframes: {solo: scan/*.png}\ntravel: {poses: tool.csv, of: tool}\n");
  const auto scanned =
      run_lightstripe("reconstruct " + quoted(folder / "scan.yaml") + " -o " + quoted(folder / "cloud.ply"));
  ASSERT_EQ(scanned.exit_code, 0) << scanned.err;
  const auto cloud = read_cloud(folder / "cloud.ply");
  ASSERT_GT(cloud.size(), 800u);
  double sum = 0;
  for (const CloudPoint& p : cloud)
    sum += std::pow((base_from_plate.inverse() * Vector3d(p.x, p.y, p.z)).z(), 2) /
           static_cast<double>(cloud.size());
  // The rig's own error, the hand-eye's over half a metre, the controller's in each frame.
  const double predicted = std::hypot(rig.quality.section_absolute_sigma_mm, sigma.at("tool.translation_mm"),
                                      500 * std::hypot(sigma.at("tool.rotation_deg"), 0.017) * kDegree);
  EXPECT_LT(std::sqrt(sum), 2 * predicted);
  EXPECT_LT(std::sqrt(sum), 1.0);
}

}  // namespace
}  // namespace lightstripe
