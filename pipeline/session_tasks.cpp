// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/session_tasks.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.h"
#include "io/tables.h"

namespace lightstripe {

namespace fs = std::filesystem;

namespace {

/// Whether the sensor's stripes are looked for without what is printed on the board: it goes with a picture
/// without the laser, and a checkerboard's is predicted.
bool knows_print(const Session& session, const SessionSensor& sensor) {
  return sensor.background || sensor.laser ||
         (!sensor.board.empty() && session.target.type == TargetType::kCheckerboard);
}

}  // namespace

std::vector<ViewTask> sensor_tasks(const Session& session, int index, const BackgroundPictures* background,
                                   std::vector<RejectedImage>& rejected) {
  const SessionSensor& sensor = session.sensors[static_cast<std::size_t>(index)];
  std::map<std::string, fs::path> lasers;
  if (sensor.laser)
    for (const auto& file : list_files(session.folder, *sensor.laser))
      lasers[matched_text(*sensor.laser, file)] = file;
  std::vector<ViewTask> tasks;
  if (sensor.board.empty()) return tasks;
  for (const auto& file : list_files(session.folder, sensor.board)) {
    ViewTask task;
    task.sensor = index;
    task.pose = matched_text(sensor.board, file);
    task.board = file;
    task.camera_only = sensor.no_laser;
    task.background = sensor.no_laser ? nullptr : background;
    const auto partner = lasers.find(task.pose);
    if (partner != lasers.end()) {
      task.laser = partner->second;
      lasers.erase(partner);
    } else if (sensor.laser) {
      rejected.push_back({sensor.name, file.filename().string(),
                          "no laser image of the same pose: its corners count, no stripe"});
    }
    tasks.push_back(std::move(task));
  }
  if (sensor.board_only)
    for (const auto& file : list_files(session.folder, *sensor.board_only)) {
      ViewTask task;
      task.sensor = index;
      task.pose = "board_only/" + matched_text(*sensor.board_only, file);
      task.board = file;
      task.camera_only = true;
      tasks.push_back(std::move(task));
    }
  for (const auto& [pose, file] : lasers)
    rejected.push_back({sensor.name, file.filename().string(), "no board image of the same pose"});
  return tasks;
}

std::vector<ViewTask> motion_tasks(const Session& session) {
  if (!session.motion) return {};
  const SessionMotion& motion = *session.motion;
  const auto column = motion.type == MotionType::kRotary ? "angle_deg" : "travel_mm";
  const fs::path table = session.folder / motion.travel;
  const auto travel = read_image_travel(table, column);
  const auto sensor = std::find_if(session.sensors.begin(), session.sensors.end(),
                                   [&](const auto& s) { return s.name == motion.sensor; });
  std::vector<ViewTask> tasks;
  for (const auto& file : list_files(session.folder, motion.board)) {
    const auto row = travel.find(file.filename().string());
    if (row == travel.end())
      throw Error(table.string(), "has no row for " + file.filename().string(),
                  "add its position, or move the image away");
    ViewTask task;
    task.sensor = static_cast<int>(sensor - session.sensors.begin());
    task.motion = true;
    task.travel = row->second;
    task.pose = "travel/" + file.filename().string();
    task.board = file;
    tasks.push_back(std::move(task));
  }
  return tasks;
}

SensorBackgrounds sensor_backgrounds(const Session& session) {
  SensorBackgrounds backgrounds(session.sensors.size());
  for (std::size_t i = 0; i < session.sensors.size(); ++i)
    if (const auto& pattern = session.sensors[i].background)
      backgrounds[i] = std::make_unique<BackgroundPictures>(session.folder, *pattern,
                                                            session.sensors[i].name + ": background");
  return backgrounds;
}

std::vector<ViewTask> session_tasks(const Session& session, const SensorBackgrounds& backgrounds,
                                    std::vector<RejectedImage>& rejected) {
  std::vector<ViewTask> tasks;
  for (std::size_t i = 0; i < session.sensors.size(); ++i)
    for (ViewTask& task : sensor_tasks(session, static_cast<int>(i), backgrounds[i].get(), rejected))
      tasks.push_back(std::move(task));
  for (ViewTask& task : motion_tasks(session)) tasks.push_back(std::move(task));
  return tasks;
}

std::vector<std::pair<std::string, fs::path>> board_pictures(const Session& session) {
  std::vector<RejectedImage> rejected;  // told when the pictures are looked at
  std::vector<std::pair<std::string, fs::path>> pictures;
  for (const ViewTask& task : session_tasks(session, SensorBackgrounds(session.sensors.size()), rejected))
    pictures.emplace_back(session.sensors[static_cast<std::size_t>(task.sensor)].name, task.board);
  return pictures;
}

std::vector<Channel> sensor_channels(const Session& session, const std::vector<ViewTask>& tasks) {
  std::vector<Channel> channels(session.sensors.size(), session.channel);
  if (session.channel != Channel::kAuto) return channels;
  for (std::size_t sensor = 0; sensor < channels.size(); ++sensor) {
    std::vector<fs::path> lit;
    for (const ViewTask& task : tasks) {
      if (task.sensor != static_cast<int>(sensor) || task.motion || task.camera_only) continue;
      if (!session.sensors[sensor].laser)
        lit.push_back(task.board);
      else if (!task.laser.empty())
        lit.push_back(task.laser);
    }
    if (session.sensors[sensor].heights) {
      const fs::path table = session.folder / *session.sensors[sensor].heights;
      for (const auto& [name, height] : read_image_travel(table, "height_mm"))
        lit.push_back(table.parent_path() / name);
    }
    channels[sensor] = channel_of_pictures(lit);
    if (knows_print(session, session.sensors[sensor]))
      channels[sensor] = channel_without_print(channels[sensor]);
  }
  return channels;
}

}  // namespace lightstripe
