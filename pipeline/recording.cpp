// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recording.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/tables.h"
#include "reconstruct/encoder_check.h"

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
    : rig_(rig),
      sources_(rig.sensors.size()),
      backgrounds_(rig.sensors.size()),
      travel_(scan.travel),
      step_(scan.travel_step) {
  open_sensors(scan, scan_file);
  read_positions(scan, scan_file);
  std::vector<const FrameSource*> sources;
  for (const auto& source : sources_) sources.push_back(source.get());
  map_ = map_frames(sources, frames_of_table(), scan_file + ": frames");
  refuse_other_size(scan_file);
  look_for_losses();
  look_at_backgrounds();
}

void Recording::open_sensors(const Scan& scan, const std::string& scan_file) {
  for (const auto& [name, pattern] : scan.frames) {
    const std::size_t sensor = sensor_of_name(rig_, name, scan_file + ": frames." + name,
                                              "use one of the sensors' names in the rig file");
    sources_[sensor] = open_frames(scan.folder, pattern, scan.channel);
    open_background(scan, sensor, name, pattern, scan_file);
  }
  if (scan.frames.empty())
    throw Error(scan_file + ": frames", "names no sensor", "add a line '<sensor>: <pattern>'");
}

void Recording::open_background(const Scan& scan, std::size_t sensor, const std::string& name,
                                const std::string& pattern, const std::string& scan_file) {
  const std::string background = scan.background.pattern(name);
  if (background.empty()) return;
  backgrounds_[sensor] =
      std::make_unique<BackgroundPictures>(scan.folder, background, scan_file + ": background");
  const Channel channel = sources_[sensor]->channel(), wanted = channel_without_print(channel);
  if (scan.channel == Channel::kAuto && wanted != channel)
    sources_[sensor] = open_frames(scan.folder, pattern, wanted);
}

/// What changes slowly shows in a few frames.
void Recording::look_at_backgrounds() {
  constexpr std::int64_t kLooks = 4;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    if (!sources_[s] || !backgrounds_[s]) continue;
    const std::int64_t looks = std::min(kLooks, sources_[s]->size());
    for (std::int64_t k = 0; k < looks; ++k) {
      const std::int64_t i = looks == 1 ? 0 : k * (sources_[s]->size() - 1) / (looks - 1);
      std::string doubt;
      try {
        backgrounds_[s]->light_of(sources_[s]->read(i), sources_[s]->name(i), sources_[s]->channel(), &doubt);
      } catch (const Error&) {
        continue;  // told when the frame's turn comes
      }
      if (doubt.empty()) continue;
      warnings_.push_back(doubt);
      break;
    }
  }
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
    CheckedReadings checked = check_encoder({rows.begin(), rows.end()}, rig_.motion.type);
    readings_ = std::move(checked.readings);
    for (const std::string& warning : checked.warnings)
      warnings_.push_back(fmt::format("{}: {}", table_->string(), warning));
  }
}

std::vector<std::int64_t> Recording::frames_of_table() const {
  std::vector<std::int64_t> frames;
  for (const auto& [frame, travel] : readings_) frames.push_back(frame);
  for (const auto& [frame, pose] : poses_) frames.push_back(frame);
  return frames;
}

std::int64_t Recording::key_of(std::int64_t frame) const {
  if (map_.stamps.empty() || frame < map_.first || frame >= map_.end) return frame;
  return map_.stamps[static_cast<std::size_t>(frame - map_.first)];
}

void Recording::look_for_losses() {
  for (const auto& source : sources_)
    if (source && !source->doubt().empty())
      losses_.push_back(source->file(0).filename().string() + " " + source->doubt());
  std::string starts;
  for (std::size_t s = 0; s < sources_.size(); ++s)
    if (sources_[s])
      starts += fmt::format("{}{}'s with {}", starts.empty() ? "" : ", ", rig_.sensors[s].name,
                            sources_[s]->name(0));
  if (map_.paired_by_order)
    warnings_.push_back(fmt::format(
        "the sensors' pictures are numbered apart ({}) and are paired by their order: were all cameras "
        "triggered "
        "together from the first picture on? If not, rename the files so that equal numbers belong together",
        starts));
  if (!map_.stamps.empty())
    warnings_.push_back(
        "the numbers in the pictures' names are looked up in the table as time stamps; frames are "
        "counted from 0 in their order");
  if (travel_ == TravelSource::kStep && map_.number_step > 1)
    warnings_.push_back(
        fmt::format("the pictures' numbers go in steps of {}: each picture is taken as one step of {:g}; if "
                    "pictures were "
                    "taken out of the folder, multiply the step",
                    map_.number_step, step_));
  if (!map_.stamps.empty())
    look_for_lone_stamps();
  else
    for (const std::int64_t frame : frames_of_table())
      if (frame < map_.first || frame >= map_.end) without_picture_.add(frame);
  warnings_.insert(warnings_.end(), losses_.begin(), losses_.end());
}

void Recording::look_for_lone_stamps() {
  const std::vector<std::int64_t> rows = frames_of_table();
  std::vector<std::int64_t> lone;
  for (const std::int64_t row : rows)
    if (!std::binary_search(map_.stamps.begin(), map_.stamps.end(), row)) lone.push_back(row);
  if (lone.empty() || 2 * lone.size() > rows.size()) return;  // a device that logs in times of its own
  losses_.push_back(fmt::format("{}: {} of {} time stamps have no picture, the first is {}", table_->string(),
                                lone.size(), rows.size(), lone.front()));
}

/// Beyond kCarried mm a 32-bit number errs by more than 0.001 mm. The origin is the middle of all travel or
/// poses, to whole metres, where they lie far from 0 and not about it; the same for every part of a
/// recording.
Eigen::Vector3d Recording::cloud_origin() const {
  constexpr double kCarried = 16384, kRound = 1000;
  std::vector<Eigen::Vector3d> places;
  const bool linear = rig_.motion.type != MotionType::kRotary;
  const auto add_travel = [&](double travel) {
    places.push_back(result_from_rig(rig_.motion, {travel, std::nullopt, false}).translation);
  };
  if (!readings_.empty() && linear)
    for (const auto& [frame, travel] : readings_) add_travel(travel);
  if (travel_ == TravelSource::kStep && linear)
    for (const std::int64_t frame : {map_.first, map_.end - 1})
      add_travel(step_ * static_cast<double>(frame));
  for (const auto& [frame, pose] : poses_) places.push_back((pose * posed_from_rig_).translation);
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (places.empty()) return origin;
  Eigen::Vector3d low = places.front(), high = places.front();
  for (const Eigen::Vector3d& place : places) low = low.cwiseMin(place), high = high.cwiseMax(place);
  for (int i = 0; i < 3; ++i) {
    const double middle = (low[i] + high[i]) / 2, half = (high[i] - low[i]) / 2;
    if (std::max(std::abs(low[i]), std::abs(high[i])) > kCarried && std::abs(middle) > 2 * half)
      origin[i] = std::round(middle / kRound) * kRound;
  }
  return origin;
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

const FrameSource* Recording::source_of(std::int64_t frame, int sensor, std::int64_t& index) const {
  const auto& source = sources_[static_cast<std::size_t>(sensor)];
  if (!source) return nullptr;
  index = map_.index_of(static_cast<std::size_t>(sensor), frame);
  if (index < 0)
    throw Error(fmt::format("{}, frame {}", rig_.sensors[static_cast<std::size_t>(sensor)].name, frame),
                "its picture is missing", "look for the file, or scan without it");
  return source.get();
}

GreyImage Recording::light_of(const FrameSource& source, std::int64_t index, int sensor) const {
  const auto& background = backgrounds_[static_cast<std::size_t>(sensor)];
  return background->light_of(source.read(index), source.name(index), source.channel());
}

std::optional<GreyImage> Recording::read(std::int64_t frame, int sensor) const {
  std::int64_t index = 0;
  const FrameSource* source = source_of(frame, sensor, index);
  if (source == nullptr) return std::nullopt;
  return backgrounds_[static_cast<std::size_t>(sensor)] ? light_of(*source, index, sensor)
                                                        : source->read(index);
}

std::optional<Picture> Recording::look(std::int64_t frame, int sensor) const {
  std::int64_t index = 0;
  const FrameSource* source = source_of(frame, sensor, index);
  if (source == nullptr) return std::nullopt;
  if (backgrounds_[static_cast<std::size_t>(sensor)]) return Picture(light_of(*source, index, sensor));
  return source->look(index);
}

std::optional<Channel> Recording::channel(int sensor) const {
  const auto& source = sources_[static_cast<std::size_t>(sensor)];
  return source ? std::optional(source->channel()) : std::nullopt;
}

std::optional<FramePosition> Recording::position(std::int64_t frame) const {
  switch (travel_) {
    case TravelSource::kPoses: {
      const auto pose = poses_.find(key_of(frame));
      if (pose == poses_.end()) return std::nullopt;
      return FramePosition{0.0, pose->second * posed_from_rig_, false};
    }
    case TravelSource::kFile:
      return position_at(readings_, rig_.motion.type, key_of(frame));
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
  if (travel_ == TravelSource::kPoses) return poses_.count(key_of(frame)) > 0;
  if (travel_ != TravelSource::kFile) return true;
  const auto position = position_at(readings_, rig_.motion.type, key_of(frame));
  return position && !position->interpolated;
}

std::string Recording::picture_name(std::int64_t frame, int sensor) const {
  const auto s = static_cast<std::size_t>(sensor);
  const std::int32_t index = sources_[s] ? map_.index_of(s, frame) : -1;
  return index < 0 ? "" : sources_[s]->name(index);
}

std::string Recording::picture_identity(std::int64_t frame, int sensor) const {
  std::string name = picture_name(frame, sensor);
  if (name.empty()) return name;
  const auto s = static_cast<std::size_t>(sensor);
  const std::filesystem::path file = sources_[s]->file(map_.index_of(s, frame));
  struct stat status {};  // one question, a file server may be far away
  if (::stat(file.c_str(), &status) != 0) return name;
  return fmt::format("{} {} {}.{:09}", name, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

}  // namespace lightstripe
