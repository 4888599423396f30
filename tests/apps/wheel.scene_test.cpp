// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A worn wheel on a turning stand, and a rig led by hand: simulated, reconstructed with the true rig, and
// held against the truth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "command_line.h"
#include "core/polyline_search.h"
#include "io/csv_reader.h"
#include "io/rig_file.h"
#include "io/tables.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;

using Polylines = std::map<std::int64_t, std::vector<Vector2d>>;

Polylines read_sections(const fs::path& file) {
  Polylines sections;
  CsvReader rows(file, {"frame", "u", "v"});
  while (rows.next()) sections[rows.integer(0)].push_back({rows.number(1), rows.number(2)});
  return sections;
}

/// One sensor, half the pixels, coarse boards left out: seconds.
constexpr const char* kSensor =
    "seed: 3\nboards: {count: 0}\nreflections: {per_frame: 0}\nimaging: {samples: 4}\n"
    "sensors: [{name: solo, image_size: [480, 350], focal_px: [821, 820], principal_point_px: [243, "
    "171.5]}]\n";

std::vector<Profile> simulated_profiles(const TemporaryFolder& folder, const std::string& scene) {
  write_text(folder / "scene.yaml", kSensor + scene);
  const auto made =
      run_lightstripe("simulate " + quoted(folder / "scene.yaml") + " -o " + quoted(folder / "s"));
  EXPECT_EQ(made.exit_code, 0) << made.err;
  const auto done = run_lightstripe("reconstruct " + quoted(folder / "s/scan.yaml") + " --rig " +
                                    quoted(folder / "s/truth/rig.yaml") + " -o " + quoted(folder / "c.ply") +
                                    " --profiles " + quoted(folder / "p.csv"));
  EXPECT_EQ(done.exit_code, 0) << done.err;
  return read_profiles(folder / "p.csv");
}

TEST(WheelScan, SectionsOfATurningWheelLieOnTheTrueOnes) {
  const TemporaryFolder folder;
  for (const std::string moves : {"object", "rig"}) {
    const auto profiles =
        simulated_profiles(folder, "motion: {positions: 0, moves: " + moves +
                                       "}\nscan: {frames: 5, step_deg: 40}\nrail: {profile: none}\n"
                                       "wheel: {profile: S1002, center: [0, 0, -530], axis: [0, -1, 0], "
                                       "flange_wear_mm: 2, tread_wear_mm: 1.5, eccentricity_mm: 0.4}\n");
    const Rig rig = read_rig(folder / "s/truth/rig.yaml");
    ASSERT_EQ(rig.motion.type, MotionType::kRotary);
    EXPECT_GT(rig.motion.axis_direction.y(), 0.9);  // u grows with y
    const Polylines truth = read_sections(folder / "s/truth/sections.csv");
    ASSERT_EQ(profiles.size(), 5U);
    for (const Profile& profile : profiles) {
      EXPECT_EQ(profile.travel, 40.0 * static_cast<double>(profile.frame));
      const PolylineSearch search(truth.at(profile.frame), 1.0);
      double sum = 0, squares = 0;
      int near = 0;
      for (const ProfilePoint& point : profile.points)
        if (const auto foot = search.nearest({point.u, point.v})) {
          sum += foot->signed_distance;
          squares += foot->signed_distance * foot->signed_distance;
          ++near;
        }
      ASSERT_GT(near, 200);
      EXPECT_GT(near, 0.97 * static_cast<double>(profile.points.size()));
      // 0.1 px at 0.6 mm a pixel; a frame turned the wrong way would be off by up to 0.7 mm of eccentricity.
      EXPECT_LT(std::sqrt(squares / near), 0.06) << moves << " " << profile.frame;
      EXPECT_LT(std::abs(sum / near), 0.03) << moves << " " << profile.frame;
    }
  }
}

TEST(WheelScan, TheCloudOfAWholeTurnLiesOnTheWheelAsItStoodAtTheStart) {
  const TemporaryFolder folder;
  const auto profiles = simulated_profiles(
      folder,
      "motion: {positions: 0, moves: object}\nscan: {frames: 4, step_deg: 90}\nrail: {profile: none}\n"
      "wheel: {profile: S1002, center: [0, 0, -530], axis: [0, -1, 0], eccentricity_mm: 0.5}\n");
  const Rig rig = read_rig(folder / "s/truth/rig.yaml");
  // The section's axis stands 0.5 mm above the turning one; about it the radius does not depend on the frame.
  const Vector3d center = rig.motion.axis_point + 0.5 * Vector3d::UnitZ();
  std::map<std::int64_t, double> tread_radius;
  for (const Profile& profile : profiles) {
    double sum = 0;
    int count = 0;
    for (const ProfilePoint& point : profile.points) {
      const Vector3d off = point.position - center;
      const double along = off.dot(rig.motion.axis_direction);
      const double radius = (off - along * rig.motion.axis_direction).norm();
      if (std::abs(radius - 460) > 1) continue;  // the tread about its datum
      sum += radius;
      ++count;
    }
    ASSERT_GT(count, 20) << profile.frame;
    tread_radius[profile.frame] = sum / count;
  }
  // z of the rig is the world's up to the sheet's 0.004 rad: 2e-3 mm; the mean of 20 points of 0.06 mm:
  // 0.015.
  for (const auto& [frame, radius] : tread_radius) EXPECT_NEAR(radius, tread_radius.at(0), 0.05) << frame;
}

TEST(PosesScan, ARigLedByHandGivesTheRailAsItStands) {
  const TemporaryFolder folder;
  const auto profiles = simulated_profiles(
      folder, "motion: {positions: 5}\nscan: {frames: 6, step_mm: 4, sway_deg: 3, sway_mm: 5}\n");
  ASSERT_EQ(profiles.size(), 6U);
  EXPECT_TRUE(fs::exists(folder / "s/scan/poses.csv"));
  EXPECT_FALSE(fs::exists(folder / "s/truth/sections.csv"));
  // The stripes that were to be seen, in the rig frame at travel 0, which is the poses' world.
  std::map<std::int64_t, std::vector<Vector3d>> truth;
  CsvReader rows(folder / "s/truth/stripes.csv", {"frame", "X", "Y", "Z"});
  while (rows.next())
    if (rows.integer(0) >= 0)
      truth[rows.integer(0)].push_back({rows.number(1), rows.number(2), rows.number(3)});
  for (const Profile& profile : profiles) {
    double squares = 0;
    for (const ProfilePoint& point : profile.points) {
      double nearest = 1e9;
      for (const Vector3d& p : truth.at(profile.frame))
        nearest = std::min(nearest, (p - point.position).squaredNorm());
      squares += nearest;
    }
    ASSERT_GT(profile.points.size(), 100U);
    // The true points lie 0.5 px (0.3 mm) apart: up to 0.15 mm along the line besides the stripe's 0.06.
    EXPECT_LT(std::sqrt(squares / static_cast<double>(profile.points.size())), 0.25) << profile.frame;
  }
}

}  // namespace
}  // namespace lightstripe
