// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The real pot on its turntable (shared/data/pot) through the command line: calibrate from the board, then
// reconstruct.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "command_line.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

const fs::path kPot = fs::path(LIGHTSTRIPE_SOURCE_DIR) / "../shared/data/pot";

struct FlatFit {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double height_mm = 0, rms_mm = 0;
  std::size_t points = 0;
};

/// The plane through the points, those beyond three times its rms left out.
FlatFit fit_table(std::vector<Eigen::Vector3d> points) {
  FlatFit fit;
  for (int round = 0; round < 5; ++round) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& p : points) mean += p / static_cast<double>(points.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const auto& p : points)
      scatter += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
    fit = {eigen.eigenvectors().col(0), mean.z(), std::sqrt(eigen.eigenvalues()[0]), points.size()};
    std::erase_if(points, [&](const auto& p) { return std::abs(fit.normal.dot(p - mean)) > 3 * fit.rms_mm; });
  }
  return fit;
}

struct PotScan : testing::Test {
  void SetUp() override {
    if (!fs::exists(kPot)) GTEST_SKIP() << "no data in " << kPot;
    const std::string folder = fs::canonical(kPot).string();
    for (const std::string channel : {"auto", "gray"})
      write_text(out_ / ("session_" + channel + ".yaml"),
                 "channel: " + channel +
                     "\ntarget: {type: checkerboard, inner_corners: [11, 7], square: [21.167, 21.125]}\n"
                     "sensors:\n  - {name: pot, board: '" +
                     folder + "/board/*.png'}\n");
    write_text(out_ / "scan.yaml", "rig: rig_auto.yaml\nframes: {pot: '" + folder +
                                       "/scan/*.png'}\n"
                                       "travel: {poses: '" +
                                       folder + "/poses.csv', of: pot}\n");
  }
  /// Calibrated from the boards as `channel` shows them.
  Rig calibrated(const std::string& channel, const std::string& options) {
    const fs::path rig = out_ / ("rig_" + channel + ".yaml");
    const CommandResult done = run_lightstripe(
        "calibrate " + quoted(out_ / ("session_" + channel + ".yaml")) + " -o " + quoted(rig) + options);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done.exit_code == 0 ? read_rig(rig) : Rig();
  }
  TemporaryFolder out_;
};

// A grey camera sees the line between the channels of a colour one, whose planes lie some tenths of a pixel
// beside one another: measured in the excess, the plane was 0.11 degrees off the grey one, three sigma.
TEST_F(PotScan, ColourAndGreyBoardsGiveTheSameLaserPlane) {
  for (const std::string flat : {" --calibration.board-warp false", " --calibration.board-warp true"}) {
    const Rig colour = calibrated("auto", flat), grey = calibrated("gray", flat);
    ASSERT_FALSE(colour.sensors.empty());
    ASSERT_FALSE(grey.sensors.empty());
    const Plane &a = colour.sensors[0].laser_planes[0], &b = grey.sensors[0].laser_planes[0];
    const auto together = [&](const std::string& name) {
      return std::hypot(colour.quality.sigma.at("pot.laser_planes.0." + name),
                        grey.quality.sigma.at("pot.laser_planes.0." + name));
    };
    const double angle_deg = std::acos(std::min(1.0, a.normal.dot(b.normal))) * 180 / M_PI;
    // 99 % of two estimates of one value lie closer.
    EXPECT_LT(angle_deg, 2.6 * together("normal_deg")) << flat;
    EXPECT_LT(std::abs(a.offset - b.offset), 2.6 * together("offset_mm")) << flat;
  }
}

TEST_F(PotScan, IsAPotOnATableAndNotNoise) {
  // poses.csv belongs to a camera that was calibrated with the board taken as flat, and only such a camera
  // fits it.
  ASSERT_FALSE(calibrated("auto", " --calibration.board-warp false").sensors.empty());
  const CommandResult done =
      run_lightstripe("reconstruct " + quoted(out_ / "scan.yaml") + " -o " + quoted(out_ / "cloud.ply") +
                      " --profiles " + quoted(out_ / "profiles.csv"));
  ASSERT_EQ(done.exit_code, 0) << done.err;

  // The table lies a few millimetres below the world's z = 0 (the code grid's scale in poses.csv is not
  // ours), the pot on it within 150 mm of its axis, less than 200 mm high.
  std::vector<Eigen::Vector3d> table;
  std::size_t pot = 0, below = 0, all = 0;
  for (const auto& profile : read_profiles(out_ / "profiles.csv")) {
    for (const auto& point : profile.points) {
      const Eigen::Vector3d& p = point.position;
      ++all;
      const double from_axis = (p - Eigen::Vector3d(90, 117, 0)).head<2>().norm();
      if (from_axis < 350 && std::abs(p.z() + 5.5) < 5) table.push_back(p);
      if (from_axis < 150 && p.z() > 0 && p.z() < 200) ++pot;
      if (p.z() < -15 && from_axis < 350) ++below;
    }
  }
  EXPECT_GT(all, 25000U);  // of 36 frames
  EXPECT_GT(table.size(), 6000U);
  EXPECT_GT(pot, 8000U);
  EXPECT_LT(static_cast<double>(below), 0.005 * static_cast<double>(all)) << "nothing is below the table";
  const FlatFit fit = fit_table(table);
  RecordProperty("table_rms_mm", std::to_string(fit.rms_mm));
  EXPECT_LT(std::acos(std::min(1.0, std::abs(fit.normal.z()))) * 180 / M_PI, 0.2);
  // The frames' mean heights scatter by 0.28 mm (poses.csv, 0.5 px), each frame's line by 0.3 mm (the laser
  // on printed codes), and the camera that poses.csv was made with differs from ours by 3 px in the principal
  // point: over lines of 150 mm at 550 mm that tilts each by up to 0.2 degrees, 0.4 mm. Together 0.57 mm;
  // each of the three is known to a quarter.
  EXPECT_LT(fit.rms_mm, 0.7) << fit.points << " points at z = " << fit.height_mm;
}

}  // namespace
}  // namespace lightstripe
