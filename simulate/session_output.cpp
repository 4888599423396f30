// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/session_output.h"

#include <fmt/format.h>

#include <iterator>
#include <set>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/own_files.h"
#include "io/rig_file.h"
#include "io/session_file.h"
#include "io/yaml_binding.h"
#include "simulate/board_poses.h"
#include "simulate/scene_world.h"
#include "simulate/truth_files.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

Session session_of(const Scene& scene, const ImagePlan& plan) {
  Session session;
  session.target = target_of(scene.boards);
  session.up = up_hint(plan.sensors.front());
  for (const SimulatedSensor& sensor : plan.sensors) {
    SessionSensor entry;
    entry.name = sensor.name;
    entry.board = "calib/" + sensor.name + "/board/*.png";
    if (scene.boards.images == BoardImages::kPair) entry.laser = "calib/" + sensor.name + "/laser/*.png";
    session.sensors.push_back(entry);
  }
  if (scene.motion.positions == 0) return session;
  const std::string& name = plan.sensors[motion_sensor(scene)].name;
  session.motion = SessionMotion{scene.turns() ? MotionType::kRotary : MotionType::kLinear, name,
                                 "calib/" + name + "/travel/*.png", "calib/travel.csv", scene.motion.moves};
  return session;
}

Scan scan_of(const Scene& scene, const ImagePlan& plan) {
  Scan scan;
  scan.rig = "rig.yaml";
  for (const SimulatedSensor& sensor : plan.sensors)
    scan.frames.emplace_back(sensor.name, "scan/" + sensor.name + "/*.png");
  scan.travel = scene.has_poses() ? TravelSource::kPoses : TravelSource::kFile;
  if (scene.has_poses()) {
    scan.poses_file = "scan/poses.csv";
    scan.poses_of = plan.sensors.front().name;
  } else {
    scan.travel_file = "scan/travel.csv";
  }
  return scan;
}

std::string motion_travel(const Scene& scene) {
  std::string out = scene.turns() ? "image,angle_deg\n" : "image,travel_mm\n";
  const double step = scene.turns() ? scene.motion.step_deg : scene.motion.step_mm;
  for (int i = 0; i < scene.motion.positions; ++i)
    fmt::format_to(std::back_inserter(out), "{},{}\n", board_file(i), i * step);
  return out;
}

std::string scan_travel(const Scene& scene) {
  std::string out = scene.turns() ? "frame,angle_deg\n" : "frame,travel_mm\n";
  for (int i = 0; i < scene.scan.frames; ++i)
    fmt::format_to(std::back_inserter(out), "{},{}\n", i, travel_of(scene, i));
  return out;
}

/// world_from_camera of the first sensor in every frame, the rig frame at travel 0 being the world.
std::string scan_poses(const Scene& scene, const ImagePlan& plan, const Rigid3& rig_from_world) {
  std::string out = "frame,qw,qx,qy,qz,x,y,z\n";
  for (int i = 0; i < scene.scan.frames; ++i) {
    const Rigid3 pose = rig_from_world * moved_in_scan(scene, i) * plan.sensors.front().world_from_camera;
    const Eigen::Quaterniond& q = pose.rotation;
    const Eigen::Vector3d& t = pose.translation;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{}\n", i, q.w(), q.x(), q.y(), q.z(), t.x(),
                   t.y(), t.z());
  }
  return out;
}

std::vector<NamedPose> true_poses(const ImagePlan& plan, const Rigid3& rig_from_world) {
  std::vector<NamedPose> poses;
  for (std::size_t i = 0; i < plan.board_poses.size(); ++i)
    poses.push_back({fmt::format("{:03}", i), rig_from_world * plan.board_poses[i]});
  for (const Rigid3& pose : plan.motion_board) poses.push_back({"travel", rig_from_world * pose});
  return poses;
}

constexpr const char* kMarkerFile = ".lightstripe-simulation";

/// Pictures of the user that the session's patterns would catch.
void refuse_foreign_pictures(const fs::path& output_folder, const fs::path& folder, const OwnFiles& own) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  std::set<std::string> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".png" && entry.path().filename().string().front() != '.')
      pictures.insert(entry.path().lexically_relative(output_folder).generic_string());
  own.refuse_foreign(pictures);
}

}  // namespace

std::vector<std::string> session_files() {
  return {"calibration.yaml",         "scan.yaml",           "calib/travel.csv", "scan/travel.csv",
          "scan/poses.csv",           "truth/stripes.csv",   "truth/rig.yaml",   "truth/scene.yaml",
          "truth/poses.csv",          "truth/sections.csv",  "truth/wear.csv",   "truth/README.md",
          "truth/other_sections.csv", "truth/other_wear.csv"};
}

void make_folders(const ImagePlan& plan, const fs::path& output_folder) {
  const std::vector<std::string> texts = session_files();
  std::set<std::string> planned(texts.begin(), texts.end());
  std::set<fs::path> folders;
  for (const PlannedImage& image : plan.images) {
    planned.insert(image.file);
    folders.insert((output_folder / image.file).parent_path());
  }
  OwnFiles own(output_folder, kMarkerFile);
  own.refuse_foreign(planned);
  for (const fs::path& folder : folders) refuse_foreign_pictures(output_folder, folder, own);
  const std::set<std::string> earlier = own.files();
  std::error_code failure;
  const bool was_there = fs::exists(fs::symlink_status(output_folder, failure));
  try {
    own.claim(planned);
  } catch (const Error&) {
    if (!was_there) fs::remove(output_folder, failure);  // an empty one: a full disk leaves nothing
    throw;
  }
  for (const fs::path& folder : folders) {
    fs::create_directories(folder, failure);
    if (failure)
      throw Error(folder.string(), "cannot be made: " + failure.message(), "choose another output folder");
  }
  for (const std::string& file : earlier)
    if (planned.count(file) == 0) own.remove(file);
}

void close_folders(const fs::path& output_folder) { OwnFiles(output_folder, kMarkerFile).release_missing(); }

void write_truth(const fs::path& folder, const Scene& scene, const ImagePlan& plan, const Rig& rig,
                 const std::vector<std::string>& stripes) {
  const Rigid3 to_rig = rig_from_world(rig, plan.sensors);
  std::string rows(kStripeTruthHeader);
  for (const std::string& part : stripes) rows += part;
  write_file(folder / "stripes.csv", rows);
  write_file(folder / "rig.yaml", rig_to_yaml(rig));
  write_file(folder / "scene.yaml", dump_yaml(scene));
  write_poses(folder / "poses.csv", true_poses(plan, to_rig));
  write_sections(folder, scene, plan.nominal, rig, to_rig);
  write_truth_readme(folder / "README.md");
}

SimulationSummary write_session(const fs::path& output_folder, const Scene& scene, const ImagePlan& plan) {
  SimulationSummary summary;
  summary.images = static_cast<int>(plan.images.size());
  summary.truth = output_folder / "truth";
  if (scene.motion.positions > 0) write_file(output_folder / "calib/travel.csv", motion_travel(scene));
  if (scene.boards.count > 0) {
    summary.session = output_folder / "calibration.yaml";
    write_file(summary.session, session_to_yaml(session_of(scene, plan)));
  }
  if (scene.scan.frames > 0) {
    const Rig rig = true_rig(scene, plan.sensors);
    if (scene.has_poses())
      write_file(output_folder / "scan/poses.csv",
                 scan_poses(scene, plan, rig_from_world(rig, plan.sensors)));
    else
      write_file(output_folder / "scan/travel.csv", scan_travel(scene));
    summary.scan = output_folder / "scan.yaml";
    write_file(summary.scan, scan_to_yaml(scan_of(scene, plan)));
  }
  return summary;
}

}  // namespace lightstripe
