// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "io/atomic_file.h"
#include "io/images.h"
#include "io/nominal_outlines.h"
#include "io/rig_file.h"
#include "io/session_file.h"
#include "io/tables.h"
#include "simulate/optics.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// The default scene with fewer and smaller pictures.
Scene small_scene() {
  Scene scene;
  scene.boards.count = 3;
  scene.boards.margin_px = 3;
  scene.motion.positions = 3;
  scene.scan.frames = 4;
  scene.scan.truth_spacing_mm = 1;
  scene.reflections.radius_px = {2, 8};
  for (SceneSensor& sensor : scene.sensors) {
    sensor.image_size = {320, 234};
    for (double& f : sensor.focal_px) f /= 3;
    for (double& c : sensor.principal_point_px) c /= 3;
  }
  return scene;
}

using Files = std::map<std::string, std::string>;

Files files_below(const fs::path& folder) {
  Files out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) out[fs::relative(entry.path(), folder).string()] = read_file(entry.path());
  return out;
}

/// Rows of a table by column name.
std::vector<std::map<std::string, std::string>> table(const fs::path& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::string> names;
  for (std::istringstream head(line); std::getline(head, cell, ',');) names.push_back(cell);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(file, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (const std::string& name : names) std::getline(cells, rows.back()[name], ',');
  }
  return rows;
}

double number(const std::map<std::string, std::string>& row, const std::string& name) {
  return std::stod(row.at(name));
}

class Simulation : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("lightstripe_simulate_" + std::to_string(getpid()));
    fs::remove_all(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(Simulation, GivesTheSameBitsForAnyNumberOfThreads) {
  simulate_scene(small_scene(), folder / "one", 1);
  simulate_scene(small_scene(), folder / "four", 4);
  const Files one = files_below(folder / "one"), four = files_below(folder / "four");
  ASSERT_EQ(one.size(), four.size());
  for (const auto& [name, bytes] : one) EXPECT_TRUE(four.at(name) == bytes) << name;
}

TEST_F(Simulation, AnotherSeedGivesOtherPictures) {
  Scene scene = small_scene();
  simulate_scene(scene, folder / "a", 0);
  scene.seed = 2;
  simulate_scene(scene, folder / "b", 0);
  const Files a = files_below(folder / "a"), b = files_below(folder / "b");
  for (const auto& [name, bytes] : a)
    if (name.ends_with(".png")) {
      EXPECT_FALSE(b.at(name) == bytes) << name;
    }
}

TEST_F(Simulation, WritesASessionAndAScanThatTheReadersTake) {
  const Scene scene = small_scene();
  int calls = 0, last = 0;
  const SimulationSummary summary = simulate_scene(scene, folder, 0, [&](int done, int total) {
    EXPECT_EQ(done, ++calls);
    last = total;
  });
  EXPECT_EQ(summary.images, 2 * (3 * 2 + 4) + 3);
  EXPECT_EQ(calls, summary.images);
  EXPECT_EQ(last, summary.images);
  const Session session = read_session(summary.session);
  EXPECT_EQ(session.target.columns, 11);
  for (const SessionSensor& sensor : session.sensors) {
    EXPECT_EQ(list_files(folder, sensor.board).size(), 3U);
    EXPECT_EQ(list_files(folder, *sensor.laser).size(), 3U);
  }
  ASSERT_TRUE(session.motion);
  const auto travel = read_image_travel(folder / session.motion->travel, "travel_mm");
  EXPECT_EQ(travel.at("002.png"), 2 * scene.motion.step_mm);
  EXPECT_EQ(list_files(folder, session.motion->board).size(), 3U);
  const Scan scan = read_scan(summary.scan);
  EXPECT_EQ(read_frame_travel(folder / scan.travel_file, "travel_mm").at(3), 3 * scene.scan.step_mm);
  for (const auto& [name, pattern] : scan.frames) EXPECT_EQ(list_files(folder, pattern).size(), 4U) << name;
  const Image8 frame = read_image(folder / "scan/gauge/0001.png");
  EXPECT_EQ(frame.width, 320);
  const Rig rig = read_rig(summary.truth / "rig.yaml");
  EXPECT_EQ(rig.sensors.size(), 2U);
  EXPECT_EQ(rig.motion.type, MotionType::kLinear);
}

TEST_F(Simulation, LeavesNoFramesOfAnEarlierLongerRun) {
  Scene scene = small_scene();
  scene.scan.frames = 6;
  simulate_scene(scene, folder, 0);
  write_file(folder / "scan/gauge/notes.txt", "mine");
  scene.scan.frames = 2;
  simulate_scene(scene, folder, 0);
  EXPECT_EQ(list_files(folder, "scan/gauge/*.png").size(), 2U);
  EXPECT_TRUE(fs::exists(folder / "scan/gauge/notes.txt"));
}

// What another program finds by the rig file alone: a stripe point's ray meets the laser plane at the point's
// true place, and the place, moved back by the travel, lies on the true section.
TEST_F(Simulation, TruthsAgreeWithEachOther) {
  Scene scene = small_scene();
  scene.rail.vertical_wear_mm = {0, 3};
  scene.rail.side_wear_mm = {1, 2};
  const SimulationSummary summary = simulate_scene(scene, folder, 0);
  const Rig rig = read_rig(summary.truth / "rig.yaml");
  std::map<int, Outline> sections;
  for (const auto& row : table(summary.truth / "sections.csv")) {
    auto& chain = sections[static_cast<int>(number(row, "frame"))].segments;
    const Eigen::Vector2d point(number(row, "u"), number(row, "v"));
    if (!chain.empty()) chain.back().to = point;
    chain.push_back(line_segment(point, point));
  }
  for (auto& [frame, section] : sections) section.segments.back().to = section.segments.front().from;
  int scan_points = 0, board_points = 0;
  for (const auto& row : table(summary.truth / "stripes.csv")) {
    const Sensor& sensor = rig.sensors[row.at("sensor") == "gauge" ? 0 : 1];
    const Vector3d ray = *unproject(sensor.camera, {number(row, "x"), number(row, "y")});
    const Vector3d p_cam = *intersect(sensor.laser_planes[0], Vector3d::Zero(), ray);
    const int frame = static_cast<int>(number(row, "frame"));
    const double travel = frame >= 0 ? frame * scene.scan.step_mm : 0;
    const Vector3d p = sensor.rig_from_camera * p_cam + travel * Vector3d::UnitX();
    // Five decimals of a pixel are 2e-5 mm.
    EXPECT_NEAR((p - Vector3d(number(row, "X"), number(row, "Y"), number(row, "Z"))).norm(), 0, 2e-4);
    if (frame < 0) ++board_points;
    if (frame < 0) continue;
    // Chords of 1 mm on R2 fall 0.06 mm short, elsewhere less; the rail's head is what matters: R13, 0.01 mm.
    EXPECT_LT(closest_point(sections.at(frame), {p.y(), p.z()}).distance, 0.07);
    ++scan_points;
  }
  EXPECT_GT(scan_points, 1000);
  EXPECT_GT(board_points, 500);
}

TEST_F(Simulation, WornSectionsAreLowerAndNarrowerFrameByFrame) {
  Scene scene = small_scene();
  scene.boards.count = 0;
  scene.motion.positions = 0;
  scene.rail.vertical_wear_mm = {0, 3};
  const SimulationSummary summary = simulate_scene(scene, folder, 0);
  EXPECT_TRUE(summary.session.empty());
  EXPECT_FALSE(fs::exists(folder / "calibration.yaml"));
  std::map<int, double> top;
  for (const auto& row : table(summary.truth / "sections.csv")) {
    const int frame = static_cast<int>(number(row, "frame"));
    top[frame] = top.count(frame) ? std::max(top[frame], number(row, "v")) : number(row, "v");
  }
  for (int frame = 1; frame < 4; ++frame) EXPECT_NEAR(top[0] - top[frame], frame, 0.01);
  EXPECT_NEAR(number(table(summary.truth / "wear.csv")[3], "vertical_wear"), 3, 1e-12);
}

TEST_F(Simulation, SingleBoardImagesShowBoardAndStripeInOne) {
  Scene scene = small_scene();
  scene.boards.images = BoardImages::kSingle;
  scene.scan.frames = 0;
  const SimulationSummary summary = simulate_scene(scene, folder, 0);
  EXPECT_FALSE(read_session(summary.session).sensors[0].laser);
  EXPECT_TRUE(summary.scan.empty());
  EXPECT_FALSE(fs::exists(folder / "calib/gauge/laser"));
  const auto rows = table(summary.truth / "stripes.csv");
  ASSERT_FALSE(rows.empty());
  const Image8 image = read_image(folder / rows[rows.size() / 2].at("image"));
  const auto& row = rows[rows.size() / 2];
  EXPECT_GT(image(static_cast<int>(number(row, "x") + 0.5), static_cast<int>(number(row, "y") + 0.5)), 25);
}

}  // namespace
}  // namespace lightstripe
