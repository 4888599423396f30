// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/observe_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "io/camera_file.h"
#include "io/images.h"
#include "io/tables.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// What is to be looked at: one pose of the board before one sensor.
struct ViewTask {
  int sensor = 0;       ///< index in the session
  bool motion = false;  ///< a view of the motion calibration
  double travel = 0;
  std::string pose;
  fs::path board;
  fs::path laser;  ///< empty: the stripe is in the board's image, or there is none (motion)
};

struct ViewResult {
  std::optional<BoardView> view;
  SeenPicture picture;
  int width = 0, height = 0;
  std::vector<RejectedImage> rejected;
};

/// Pairs board and laser images by the text that the '*' stands for; a laser image alone is reported, not
/// used.
std::vector<ViewTask> sensor_tasks(const Session& session, int index, std::vector<RejectedImage>& rejected) {
  const SessionSensor& sensor = session.sensors[static_cast<std::size_t>(index)];
  std::map<std::string, fs::path> lasers;
  if (sensor.laser)
    for (const auto& file : list_files(session.folder, *sensor.laser))
      lasers[matched_text(*sensor.laser, file)] = file;
  std::vector<ViewTask> tasks;
  for (const auto& file : list_files(session.folder, sensor.board)) {
    ViewTask task;
    task.sensor = index;
    task.pose = matched_text(sensor.board, file);
    task.board = file;
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

/// The board in a picture that may show the laser as well: of colour pictures other channels are tried where
/// grey fails.
BoardDetection find_board(const fs::path& file, const Session& session, Image8& image) {
  const bool automatic = session.channel == Channel::kAuto || enum_name(session.channel).ends_with("-excess");
  image = read_image(file, automatic ? Channel::kGray : session.channel);
  BoardDetection detection = detect_board(image, session.target);
  if (detection.found || !automatic) return detection;
  for (const Channel channel : {Channel::kBlue, Channel::kGreen, Channel::kRed}) {
    const Image8 other = read_image(file, channel);
    if (other.pixels == image.pixels) break;  // a picture without colour
    BoardDetection again = detect_board(other, session.target);
    if (again.found) return again;
  }
  return detection;
}

ViewResult observe_view(const ViewTask& task, const Session& session, const ExtractionOptions& extraction) {
  const SessionSensor& sensor = session.sensors[static_cast<std::size_t>(task.sensor)];
  ViewResult result;
  Image8 board;
  const BoardDetection detection = find_board(task.board, session, board);
  result.width = board.width;
  result.height = board.height;
  const std::string name = task.motion ? task.pose : task.board.filename().string();
  result.picture = {sensor.name, name, detection.reason, task.board, task.laser, detection.corners, {}};
  if (!detection.found) {
    result.rejected.push_back({sensor.name, name, detection.reason});
    return result;
  }
  BoardView view{name, task.pose, detection.corners, {}};
  const bool single = !sensor.laser && !task.motion;
  if (single || !task.laser.empty()) {
    Channel channel = session.channel;
    const Image8 laser = read_image(single ? task.board : task.laser, session.channel, &channel);
    if (laser.width != board.width || laser.height != board.height)
      throw Error(task.laser.string(),
                  fmt::format("is {} x {} px, its board image {} x {}", laser.width, laser.height,
                              board.width, board.height),
                  "give images of one camera and one setting");
    // The difference of the pair needs the same channel in both; a single picture has nothing to subtract.
    const Image8 dark = single ? Image8() : read_image(task.board, channel);
    const StripeOnBoard stripe =
        find_stripe_on_board(laser, single ? ImageView8() : dark.view(), detection.corners, session.target,
                             sensor.laser_planes, extraction);
    view.stripes = stripe.planes;
    result.picture.stripes = stripe.planes;
    if (!stripe.reason.empty()) result.picture.reason = "stripe: " + stripe.reason;
    if (!stripe.reason.empty()) result.rejected.push_back({sensor.name, name, "stripe: " + stripe.reason});
  }
  result.view = std::move(view);
  return result;
}

CalibrationObservations empty_observations(const Session& session) {
  CalibrationObservations observations;
  observations.target = session.target;
  observations.up = session.up;
  for (const auto& sensor : session.sensors) {
    SensorObservations seen;
    seen.name = sensor.name;
    seen.laser_planes = sensor.laser_planes;
    if (sensor.camera)
      seen.given_camera =
          GivenCamera{read_camera_file((session.folder / *sensor.camera).string()), sensor.camera_fixed};
    observations.sensors.push_back(std::move(seen));
  }
  if (session.motion) {
    MotionObservations motion;
    motion.type = session.motion->type;
    motion.rig_moves = session.motion->rig_moves;
    for (std::size_t i = 0; i < session.sensors.size(); ++i)
      if (session.sensors[i].name == session.motion->sensor) motion.sensor = static_cast<int>(i);
    observations.motion = std::move(motion);
  }
  return observations;
}

void check_size(SensorObservations& sensor, const ViewTask& task, const ViewResult& result) {
  if (sensor.width == 0) {
    sensor.width = result.width;
    sensor.height = result.height;
  }
  if (sensor.width != result.width || sensor.height != result.height)
    throw Error(task.board.string(),
                fmt::format("is {} x {} px, the sensor's other images {} x {}", result.width, result.height,
                            sensor.width, sensor.height),
                "give images of one camera and one setting");
  if (!sensor.given_camera) return;
  Camera& camera = sensor.given_camera->camera;
  if (camera.width == 0) camera.width = sensor.width, camera.height = sensor.height;
  if (camera.width != sensor.width || camera.height != sensor.height)
    throw Error(task.board.string(),
                fmt::format("is {} x {} px, the given camera of {} {} x {}", sensor.width, sensor.height,
                            sensor.name, camera.width, camera.height),
                "give the camera of this picture size");
}

}  // namespace

SessionObservations observe_session(const Session& session, const ExtractionOptions& extraction,
                                    const ProgressCallback& progress, const std::stop_token& stop) {
  SessionObservations seen;
  std::vector<ViewTask> tasks;
  for (std::size_t i = 0; i < session.sensors.size(); ++i)
    for (auto& task : sensor_tasks(session, static_cast<int>(i), seen.rejected))
      tasks.push_back(std::move(task));
  for (auto& task : motion_tasks(session)) tasks.push_back(std::move(task));

  std::vector<ViewResult> results(tasks.size());
  StepCounter steps("looking for boards", "images", static_cast<std::int64_t>(tasks.size()), progress);
  parallel_for(tasks.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    results[i] = observe_view(tasks[i], session, extraction);
    steps.step();
  });
  if (stop.stop_requested())
    throw Error((session.folder).string(), "the run was stopped before all pictures were looked at",
                "run it again");

  seen.observations = empty_observations(session);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    SensorObservations& sensor = seen.observations.sensors[static_cast<std::size_t>(tasks[i].sensor)];
    check_size(sensor, tasks[i], results[i]);
    ++seen.images;
    seen.pictures.push_back(std::move(results[i].picture));
    seen.rejected.insert(seen.rejected.end(), results[i].rejected.begin(), results[i].rejected.end());
    if (!results[i].view) continue;
    ++seen.boards_found;
    if (tasks[i].motion) {
      seen.observations.motion->views.push_back(std::move(*results[i].view));
      seen.observations.motion->travel.push_back(tasks[i].travel);
    } else {
      sensor.views.push_back(std::move(*results[i].view));
    }
  }
  return seen;
}

}  // namespace lightstripe
