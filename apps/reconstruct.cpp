// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/reconstruct.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <map>
#include <memory>

#include "apps/preview.h"
#include "apps/progress.h"
#include "apps/run_record.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/rig_file.h"
#include "io/session_file.h"
#include "io/tables.h"
#include "reconstruct/cloud.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// The recordings of the rig's sensors; a sensor that the scan does not name has none.
std::vector<std::unique_ptr<FrameSource>> open_sensors(const Scan& scan, const std::string& scan_file, const Rig& rig) {
  std::vector<std::unique_ptr<FrameSource>> sources(rig.sensors.size());
  for (const auto& [name, pattern] : scan.frames) {
    std::size_t index = 0;
    while (index < rig.sensors.size() && rig.sensors[index].name != name) ++index;
    if (index == rig.sensors.size())
      throw Error(scan_file + ": frames." + name, "the rig has no sensor of this name",
                  "use one of the sensors' names in the rig file");
    sources[index] = open_frames(scan.folder, pattern, scan.channel);
  }
  return sources;
}

std::int64_t common_length(const std::vector<std::unique_ptr<FrameSource>>& sources, const Rig& rig,
                           const std::string& scan_file) {
  std::int64_t length = -1;
  std::string first;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!sources[i]) continue;
    if (length >= 0 && sources[i]->size() != length)
      throw Error(scan_file + ": frames",
                  fmt::format("{} has {} frames, {} has {}", first, length, rig.sensors[i].name, sources[i]->size()),
                  "give every sensor the same frames, so that the n-th of each belong together");
    length = sources[i]->size();
    first = rig.sensors[i].name;
  }
  if (length < 0) throw Error(scan_file + ": frames", "names no sensor", "add a line '<sensor>: <pattern>'");
  return length;
}

using PositionOf = std::function<std::optional<FramePosition>(std::int64_t)>;

PositionOf positions_from_poses(const Scan& scan, const std::string& scan_file, const Rig& rig) {
  auto poses = read_poses(scan.folder / scan.poses_file);
  Rigid3 of_from_rig;  // the frame that the poses are of
  if (scan.poses_of != "rig") {
    const auto sensor = std::find_if(rig.sensors.begin(), rig.sensors.end(),
                                     [&](const Sensor& s) { return s.name == scan.poses_of; });
    if (sensor == rig.sensors.end())
      throw Error(scan_file + ": travel.of", "the rig has no sensor '" + scan.poses_of + "'", "name a sensor, or 'rig'");
    of_from_rig = sensor->rig_from_camera.inverse();
  }
  return [poses = std::move(poses), of_from_rig](std::int64_t frame) -> std::optional<FramePosition> {
    const auto pose = poses.find(frame);
    if (pose == poses.end()) return std::nullopt;
    return FramePosition{0.0, pose->second * of_from_rig};
  };
}

PositionOf frame_positions(const Scan& scan, const std::string& scan_file, const Rig& rig) {
  switch (scan.travel) {
    case TravelSource::kPoses:
      return positions_from_poses(scan, scan_file, rig);
    case TravelSource::kFile: {
      const auto column = rig.motion.type == MotionType::kRotary ? "angle_deg" : "travel_mm";
      auto travel = read_frame_travel(scan.folder / scan.travel_file, column);
      return [travel = std::move(travel)](std::int64_t frame) -> std::optional<FramePosition> {
        const auto row = travel.find(frame);
        if (row == travel.end()) return std::nullopt;
        return FramePosition{row->second, std::nullopt};
      };
    }
    case TravelSource::kStep:
      return [step = scan.travel_step](std::int64_t frame) {
        return std::optional(FramePosition{step * static_cast<double>(frame), std::nullopt});
      };
    case TravelSource::kNone:
      break;
  }
  return [](std::int64_t) { return std::optional(FramePosition{}); };
}

/// profiles.csv as it grows, under its final name only when complete.
class ProfileTable {
 public:
  explicit ProfileTable(const std::string& path) : file_(path), out_(file_.temporary(), std::ios::binary) {
    out_ << kProfilesHeader;
  }
  void append(const Profile& profile) {
    rows_.clear();
    append_profile(rows_, profile);
    out_ << rows_;
  }
  void commit() {
    out_.close();
    if (!out_) throw Error(file_.path().string(), "writing failed", "check the disk's free space");
    file_.commit();
  }

 private:
  AtomicFile file_;
  std::ofstream out_;
  std::string rows_;
};

std::string output_of(const ReconstructArguments& arguments) {
  return arguments.common.output.empty() ? "cloud.ply" : arguments.common.output;
}

void report_gaps(const ScanSummary& summary) {
  if (summary.frames_without_position > 0)
    warn(fmt::format("{} frames have no position and are left out", summary.frames_without_position));
  if (summary.frames_without_points > 0) warn(fmt::format("{} frames show no stripe", summary.frames_without_points));
  if (summary.rays_missed > 0)
    warn(fmt::format("{} stripe points do not meet their laser plane and are left out", summary.rays_missed));
}

int run_reconstruct(const ReconstructArguments& arguments) {
  const ReconstructOutcome outcome = reconstruct_scan(arguments);
  report_gaps(outcome.summary);
  if (outcome.summary.points == 0)
    return not_usable("no stripe was found in any of the " + std::to_string(outcome.summary.frames) +
                      " frames (nothing is written); look at a frame with `lightstripe extract --overlay`");
  say(arguments.common, fmt::format("{} frames, {} points in {:.2f} s ({:.1f} frames/s) -> {}", outcome.summary.frames,
                                    outcome.summary.points, outcome.seconds,
                                    static_cast<double>(outcome.summary.frames) / outcome.seconds, output_of(arguments)));
  return kExitDone;
}

}  // namespace

ReconstructOutcome reconstruct_scan(const ReconstructArguments& arguments) {
  const ThreadLimit limit(arguments.common);
  const Scan scan = read_scan(arguments.scan);
  const fs::path rig_file = arguments.rig.empty() ? scan.folder / scan.rig : fs::path(arguments.rig);
  const Rig rig = read_rig(rig_file);
  ExtractionOptions extraction;
  read_subtree(scan.extraction, extraction);
  apply_overrides(extraction, arguments.extraction);
  const auto sources = open_sensors(scan, arguments.scan, rig);

  ScanInput input;
  input.num_frames = common_length(sources, rig, arguments.scan);
  input.position = frame_positions(scan, arguments.scan, rig);
  input.read = [&](std::int64_t frame, int sensor) -> std::optional<Image8> {
    const auto& source = sources[static_cast<std::size_t>(sensor)];
    if (!source) return std::nullopt;
    return source->read(frame);
  };

  const std::string output = output_of(arguments);
  AtomicFile cloud_file(output);
  CloudWriter cloud(cloud_file.temporary(), output);
  std::optional<ProfileTable> profiles;
  if (!arguments.profiles.empty()) profiles.emplace(arguments.profiles);
  CloudPreview preview;
  ReconstructOutcome outcome;
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("reconstructing", "frames", input.num_frames, arguments.common.quiet);
    outcome.summary = scan_profiles(input, rig, extraction, thread_count(arguments.common), [&](const Profile& profile) {
      cloud.append(profile);
      if (profiles) profiles->append(profile);
      if (!arguments.preview.empty()) preview.add(profile);
      progress.step();
    });
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cloud.finish();
  if (outcome.summary.points == 0) return outcome;
  cloud_file.commit();
  if (profiles) profiles->commit();
  if (!arguments.preview.empty()) {
    const RgbPicture picture = preview.draw();
    write_rgb_image(arguments.preview, picture.pixels, picture.width, picture.height);
  }
  write_run_record(output, "reconstruct", {arguments.scan, rig_file}, "extraction:\n" + indented(dump_yaml(extraction)));
  return outcome;
}

void add_reconstruct_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("reconstruct", "a recorded scan to a point cloud and sections");
  auto arguments = std::make_shared<ReconstructArguments>();
  command->add_option("scan", arguments->scan, "scan (YAML)")->required();
  add_common_options(*command, arguments->common, "cloud: .ply, .pcd or .xyz (default: cloud.ply)");
  command->add_option("--rig", arguments->rig, "rig file (default: the one that the scan names)");
  command->add_option("--profiles", arguments->profiles, "table of sections (CSV)");
  command->add_option("--preview", arguments->preview, "picture of the cloud (PNG)");
  add_field_options<ExtractionOptions>(*command, "extraction.", arguments->extraction);
  command->callback([arguments, &run] { run = [arguments] { return run_reconstruct(*arguments); }; });
}

}  // namespace lightstripe
