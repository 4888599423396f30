// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/observe_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "calib/board/board_shift.h"
#include "calib/board/straight_lines.h"
#include "core/counted.h"
#include "core/error.h"
#include "core/robust.h"
#include "extraction/extract_stripes.h"
#include "io/camera_file.h"
#include "io/images.h"
#include "io/tables.h"
#include "pipeline/session_tasks.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct ViewResult {
  std::optional<BoardView> view;
  SeenPicture picture;
  int width = 0, height = 0;
  std::vector<RejectedImage> rejected;
  int seen_columns = 0, seen_rows = 0;  ///< of the squares in a picture where the board was not found
  double circle_mm = 0;
};

/// The laser's colour hides the board, or leaves nothing of it: boards are looked for in grey.
Channel board_channel(const Session& session) {
  const bool of_the_laser =
      session.channel == Channel::kAuto || enum_name(session.channel).find('-') != std::string_view::npos;
  return of_the_laser ? Channel::kGray : session.channel;
}

/// The board in a picture that may show the laser as well: of colour pictures other channels are tried where
/// grey fails.
BoardDetection find_board(const fs::path& file, const Session& session, Image8& image) {
  image = read_image(file, board_channel(session));
  BoardDetection detection = detect_board(image, session.target);
  if (detection.found || session.channel == Channel::kGray || board_channel(session) != Channel::kGray ||
      !detection.board_like)
    return detection;
  for (const Channel channel : {Channel::kBlue, Channel::kGreen, Channel::kRed}) {
    const Image8 other = read_image(file, channel);
    if (other.pixels == image.pixels) break;  // a picture without colour
    BoardDetection again = detect_board(other, session.target);
    if (again.found) return again;
  }
  return detection;
}

/// Whether the board stood still within the pair, judged where it is seen best; empty if so.
std::string moved_within_pair(const ViewTask& task, const Session& session, const Image8& board,
                              const std::vector<Eigen::Vector2d>& corners) {
  constexpr double kMovedPx = 1;
  const Image8 laser = read_image(task.laser, board_channel(session));
  const auto shift = board_shift_px(laser, board, corners, session.target);
  if (!shift || *shift <= kMovedPx) return "";
  return fmt::format("the board moved by {:.1f} px between the picture without laser and that with it",
                     *shift);
}

/// The stripe in the laser's light alone; the reason where the background does not fit.
StripeOnBoard stripe_without_background(const ViewTask& task, const Image8& laser, Channel channel,
                                        const std::vector<Eigen::Vector2d>& corners, const Target& target,
                                        int planes, const ExtractionOptions& extraction) {
  const fs::path& file = task.laser.empty() ? task.board : task.laser;
  try {
    const GreyImage light = task.background->light_of(laser, file, channel);
    return find_stripe_in_light(std::get<Image8>(light), corners, target, planes, extraction);
  } catch (const Error& error) {
    StripeOnBoard unknown;
    unknown.reason = error.what();
    return unknown;
  }
}

/// The stripe of a view; `laser` shows it in `channel`, `board` the board as it was found.
StripeOnBoard stripe_of(const ViewTask& task, const Session& session, const Image8& laser,
                        const Image8& board, Channel channel, const std::vector<Eigen::Vector2d>& corners,
                        const Target& target, const ExtractionOptions& extraction) {
  const int planes = session.sensors[static_cast<std::size_t>(task.sensor)].laser_planes;
  if (task.background != nullptr)
    return stripe_without_background(task, laser, channel, corners, target, planes, extraction);
  if (task.laser.empty())
    return find_stripe_on_board(laser, ImageView8(), corners, target, planes, extraction);
  StripeOnBoard moved;
  moved.reason = moved_within_pair(task, session, board, corners);
  if (!moved.reason.empty()) return moved;
  // The difference of the pair needs the same channel in both.
  const Image8 dark = read_image(task.board, channel);
  return find_stripe_on_board(laser, dark.view(), corners, target, planes, extraction);
}

ViewResult observe_view(const ViewTask& task, const Session& session, Channel channel,
                        const ExtractionOptions& extraction) {
  const SessionSensor& sensor = session.sensors[static_cast<std::size_t>(task.sensor)];
  ViewResult result;
  Image8 board;
  const BoardDetection detection = find_board(task.board, session, board);
  result.width = board.width;
  result.height = board.height;
  const std::string name = task.motion ? task.pose : task.board.filename().string();
  result.picture = {sensor.name, name, detection.reason, task.board, task.laser, detection.corners, {}};
  result.circle_mm = detection.circle_mm;
  if (!detection.found) {
    result.rejected.push_back({sensor.name, name, detection.reason});
    result.seen_columns = detection.seen_columns;
    result.seen_rows = detection.seen_rows;
    return result;
  }
  BoardView view{name, task.pose, detection.corners, {}, !task.laser.empty()};
  const bool single = !sensor.laser && !task.motion && !task.camera_only;
  Target target = session.target;
  if (target.circle_mm == 0) target.circle_mm = detection.circle_mm;
  if (single || !task.laser.empty()) {
    const Image8 laser = read_image(single ? task.board : task.laser, channel);
    if (laser.width != board.width || laser.height != board.height)
      throw Error(task.laser.string(),
                  fmt::format("is {} x {} px, its board image {} x {}", laser.width, laser.height,
                              board.width, board.height),
                  "give images of one camera and one setting");
    const StripeOnBoard stripe =
        stripe_of(task, session, laser, board, channel, view.corners, target, extraction);
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
    motion.moves = session.motion->moves;
    for (std::size_t i = 0; i < session.sensors.size(); ++i)
      if (session.sensors[i].name == session.motion->sensor) motion.sensor = static_cast<int>(i);
    observations.motion = std::move(motion);
  }
  return observations;
}

/// The tool's pose for each board picture that the table names; a table that names none of them is refused.
std::optional<std::vector<ToolPose>> poses_of_tool(const Session& session,
                                                   const std::vector<ViewTask>& tasks) {
  if (!session.tool_poses) return std::nullopt;
  const fs::path table = session.folder / *session.tool_poses;
  const auto by_image = read_image_poses(table);
  std::map<std::string, Rigid3> by_pose;
  for (const auto& task : tasks) {
    const auto row = by_image.find(task.board.filename().string());
    if (row != by_image.end() && !task.motion) by_pose[task.pose] = row->second;
  }
  if (by_pose.empty())
    throw Error(table.string(), "names none of the session's board pictures",
                "give their file names in the column image");
  std::vector<ToolPose> poses;
  for (const auto& [pose, base_from_tool] : by_pose) poses.push_back({pose, base_from_tool});
  return poses;
}

/// Where the pictures agree on squares of another number than the session's, they say so together.
void note_common_size(const Session& session, std::vector<ViewResult>& results) {
  constexpr int kMin = 3;
  std::map<std::array<int, 2>, int> counts;
  int unseen = 0;
  for (const auto& result : results) {
    if (result.view) continue;
    ++unseen;
    if (result.seen_columns > 0) ++counts[{result.seen_columns, result.seen_rows}];
  }
  const auto commonest = std::max_element(counts.begin(), counts.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
  if (commonest == counts.end() || commonest->second < kMin || 2 * commonest->second < unseen ||
      2 * unseen < static_cast<int>(results.size()))
    return;
  const auto [columns, rows] = commonest->first;
  if (columns == session.target.columns && rows == session.target.rows) return;
  const std::string reason = fmt::format("{} {} x {} inner corners, the session says {} x {}",
                                         commonest->second == static_cast<int>(results.size())
                                             ? "all pictures show"
                                             : counted(commonest->second, "picture shows", "pictures show"),
                                         columns, rows, session.target.columns, session.target.rows);
  for (auto& result : results) {
    if (result.view || result.seen_columns != columns || result.seen_rows != rows) continue;
    result.picture.reason = reason;
    for (auto& rejected : result.rejected) rejected.reason = reason;
  }
}

/// The circles' diameter where the session does not give it: the median over the pictures.
double common_circle_mm(const std::vector<ViewResult>& results) {
  std::vector<double> seen;
  for (const auto& result : results)
    if (result.view && result.circle_mm > 0) seen.push_back(result.circle_mm);
  if (seen.empty()) return 0;
  return upper_median(seen);
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

/// The board on the bed, and the lines in the pictures of known heights; pictures lie beside the table.
void observe_bed(const Session& session, std::size_t index, const BackgroundPictures* background,
                 Channel channel, const ExtractionOptions& extraction, SessionObservations& seen) {
  const SessionSensor& sensor = session.sensors[index];
  if (!sensor.bed) return;
  const fs::path bed = session.folder / *sensor.bed, table = session.folder / *sensor.heights;
  Image8 image;
  const BoardDetection board = find_board(bed, session, image);
  if (!board.found)
    throw Error(bed.string(), "shows no board: " + board.reason,
                "take the picture with the board lying flat on the bed, laser off");
  SensorObservations& observed = seen.observations.sensors[index];
  observed.width = image.width;
  observed.height = image.height;
  if (observed.given_camera && observed.given_camera->camera.width == 0) {
    observed.given_camera->camera.width = image.width;
    observed.given_camera->camera.height = image.height;
  }
  ++seen.images;
  ++seen.boards_found;
  BedObservations result;
  result.board.image = bed.filename().string();
  result.board.corners = board.corners;
  for (const auto& [name, height] : read_image_travel(table, "height_mm")) {
    const fs::path file = table.parent_path() / name;
    Image8 picture = read_image(file, channel);
    if (picture.width != image.width || picture.height != image.height)
      throw Error(file.string(), "has another size than " + bed.string(),
                  "give images of one camera and one setting");
    if (background != nullptr) picture = std::get<Image8>(background->light_of(picture, file, channel));
    HeightView view{name, height, straight_lines(extract_stripes(picture, extraction).stripes)};
    if (view.lines.empty())
      seen.rejected.push_back({sensor.name, name, "no straight line; is the laser on in this picture?"});
    else
      result.heights.push_back(std::move(view));
  }
  observed.bed = std::move(result);
}

}  // namespace

SessionObservations observe_session(const Session& session, const ExtractionOptions& extraction,
                                    const ProgressCallback& progress, const std::stop_token& stop) {
  SessionObservations seen;
  const SensorBackgrounds backgrounds = sensor_backgrounds(session);
  const std::vector<ViewTask> tasks = session_tasks(session, backgrounds, seen.rejected);
  const std::vector<Channel> channels = sensor_channels(session, tasks);
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (!session.sensors[i].no_laser || session.sensors[i].heights)
      seen.channels.push_back({session.sensors[i].name, channels[i]});
  std::vector<ViewResult> results(tasks.size());
  StepCounter steps("looking for boards", "images", static_cast<std::int64_t>(tasks.size()), progress);
  parallel_for(tasks.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    results[i] =
        observe_view(tasks[i], session, channels[static_cast<std::size_t>(tasks[i].sensor)], extraction);
    steps.step();
  });
  if (stop.stop_requested())
    throw Error((session.folder).string(), "the run was stopped before all pictures were looked at",
                "run it again");

  note_common_size(session, results);
  const auto tool_poses = poses_of_tool(session, tasks);
  seen.observations = empty_observations(session);
  seen.observations.tool_poses = tool_poses;
  if (seen.observations.target.circle_mm == 0) seen.observations.target.circle_mm = common_circle_mm(results);
  for (std::size_t i = 0; i < session.sensors.size(); ++i)
    observe_bed(session, i, backgrounds[i].get(), channels[i], extraction, seen);
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
