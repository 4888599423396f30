// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recording.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "io/tables.h"

namespace lightstripe {
namespace {

std::size_t sensor_of_name(const Rig& rig, const std::string& name, const std::string& key,
                           const char* what_to_do) {
  const auto found =
      std::find_if(rig.sensors.begin(), rig.sensors.end(), [&](const Sensor& s) { return s.name == name; });
  if (found == rig.sensors.end()) throw Error(key, "the rig has no sensor '" + name + "'", what_to_do);
  return static_cast<std::size_t>(found - rig.sensors.begin());
}

}  // namespace

Recording::Recording(const Scan& scan, const std::string& scan_file, const Rig& rig)
    : rig_(rig), sources_(rig.sensors.size()), travel_(scan.travel), step_(scan.travel_step) {
  open_sensors(scan, scan_file);
  read_positions(scan, scan_file);
  std::vector<const FrameSource*> sources;
  for (const auto& source : sources_) sources.push_back(source.get());
  map_ = map_frames(sources, frames_of_table(), scan_file + ": frames");
  refuse_other_size(scan_file);
}

void Recording::open_sensors(const Scan& scan, const std::string& scan_file) {
  for (const auto& [name, pattern] : scan.frames) {
    const std::size_t sensor = sensor_of_name(rig_, name, scan_file + ": frames." + name,
                                              "use one of the sensors' names in the rig file");
    sources_[sensor] = open_frames(scan.folder, pattern, scan.channel);
  }
  if (scan.frames.empty())
    throw Error(scan_file + ": frames", "names no sensor", "add a line '<sensor>: <pattern>'");
}

void Recording::read_positions(const Scan& scan, const std::string& scan_file) {
  if (travel_ == TravelSource::kPoses) {
    table_ = scan.folder / scan.poses_file;
    poses_ = read_poses(*table_);
    if (scan.poses_of == "rig") return;
    if (scan.poses_of == "tool") {
      if (!rig_.tool_from_rig)
        throw Error(scan_file + ": travel.of", "is tool, but the rig does not know where it sits on the tool",
                    "calibrate it with motion: {type: poses, file: poses.csv}");
      posed_from_rig_ = *rig_.tool_from_rig;
      return;
    }
    const std::size_t sensor =
        sensor_of_name(rig_, scan.poses_of, scan_file + ": travel.of", "name a sensor, 'rig' or 'tool'");
    posed_from_rig_ = rig_.sensors[sensor].rig_from_camera.inverse();
  } else if (travel_ == TravelSource::kFile) {
    table_ = scan.folder / scan.travel_file;
    const auto rows =
        read_frame_travel(*table_, rig_.motion.type == MotionType::kRotary ? "angle_deg" : "travel_mm");
    readings_.assign(rows.begin(), rows.end());
  }
}

std::vector<std::int64_t> Recording::frames_of_table() const {
  std::vector<std::int64_t> frames;
  for (const auto& [frame, travel] : readings_) frames.push_back(frame);
  for (const auto& [frame, pose] : poses_) frames.push_back(frame);
  return frames;
}

/// A single odd picture is skipped later; a recording of another camera should not take hours to be found
/// out.
void Recording::refuse_other_size(const std::string& scan_file) const {
  constexpr std::int64_t kLooks = 3;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    if (!sources_[s]) continue;
    const Camera& camera = rig_.sensors[s].camera;
    std::string found;
    const std::int64_t looks = std::min(kLooks, sources_[s]->size());
    for (std::int64_t i = 0; i < looks; ++i) {
      try {
        const GreyImage image = sources_[s]->read(i);
        const auto [width, height] =
            std::visit([](const auto& p) { return std::pair(p.width, p.height); }, image);
        if (width == camera.width && height == camera.height) {
          found.clear();
          break;
        }
        found = fmt::format("{} has {} x {} px", sources_[s]->name(i), width, height);
      } catch (const Error&) {
        continue;  // told when the frame's turn comes
      }
    }
    if (!found.empty())
      throw Error(fmt::format("{}: frames.{}", scan_file, rig_.sensors[s].name),
                  fmt::format("{} but the rig's camera {} x {} px", found, camera.width, camera.height),
                  "use the rig that was calibrated with this camera at this picture size");
  }
}

std::optional<GreyImage> Recording::read(std::int64_t frame, int sensor) const {
  const auto& source = sources_[static_cast<std::size_t>(sensor)];
  if (!source) return std::nullopt;
  const std::int32_t index = map_.index_of(static_cast<std::size_t>(sensor), frame);
  if (index < 0)
    throw Error(fmt::format("{}, frame {}", rig_.sensors[static_cast<std::size_t>(sensor)].name, frame),
                "its picture is missing", "look for the file, or scan without it");
  return source->read(index);
}

std::optional<FramePosition> Recording::position(std::int64_t frame) const {
  switch (travel_) {
    case TravelSource::kPoses: {
      const auto pose = poses_.find(frame);
      if (pose == poses_.end()) return std::nullopt;
      return FramePosition{0.0, pose->second * posed_from_rig_, false};
    }
    case TravelSource::kFile:
      return position_at(readings_, rig_.motion.type, frame);
    case TravelSource::kStep:
      return FramePosition{step_ * static_cast<double>(frame), std::nullopt, false};
    case TravelSource::kNone:
      break;
  }
  return FramePosition{};
}

bool Recording::recorded(std::int64_t frame) const {
  for (std::size_t s = 0; s < sources_.size(); ++s)
    if (sources_[s] && map_.index_of(s, frame) >= 0) return true;
  if (travel_ == TravelSource::kPoses) return poses_.count(frame) > 0;
  if (travel_ != TravelSource::kFile) return true;
  const auto position = position_at(readings_, rig_.motion.type, frame);
  return position && !position->interpolated;
}

std::string Recording::picture_name(std::int64_t frame, int sensor) const {
  const auto s = static_cast<std::size_t>(sensor);
  const std::int32_t index = sources_[s] ? map_.index_of(s, frame) : -1;
  return index < 0 ? "" : sources_[s]->name(index);
}

}  // namespace lightstripe
