// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/session_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/counted.h"
#include "core/error.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr int kMinViews = 3;

SessionView measured(const BoardView& view, int sensor, const Target& target, int laser_planes) {
  LIGHTSTRIPE_CHECK(static_cast<int>(view.corners.size()) == target.num_corners(),
                    view.image + ": a view needs every corner of the board");
  LIGHTSTRIPE_CHECK(static_cast<int>(view.stripes.size()) <= laser_planes,
                    view.image + ": more stripes than laser planes");
  SessionView result;
  result.sensor = sensor;
  result.image = view.image;
  result.laser_apart = view.laser_apart;
  result.corners = view.corners;
  for (const auto& stripe : view.stripes) result.stripes.push_back(independent_points(stripe));
  result.stripes.resize(static_cast<std::size_t>(laser_planes));
  return result;
}

int pose_index(std::vector<std::string>& poses, const std::string& pose) {
  const auto found = std::find(poses.begin(), poses.end(), pose);
  const auto index = found - poses.begin();
  if (found == poses.end()) poses.push_back(pose);
  return static_cast<int>(index);
}

bool same_points(const std::vector<StripePoint>& a, const std::vector<StripePoint>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& p, const auto& q) {
           return p.x == q.x && p.y == q.y;
         });
}

/// The same numbers to the last bit come from the same picture only: noise differs.
bool same_corners(const SessionView& a, const SessionView& b) {
  return std::equal(
      a.corners.begin(), a.corners.end(), b.corners.begin(), b.corners.end(),
      [](const Vector2d& p, const Vector2d& q) { return p == q || (!is_seen(p) && !is_seen(q)); });
}

/// A picture that was given twice would count twice. False: the view is of no use.
bool seen_once(SessionViews& result, SessionView& added) {
  for (const auto& other : result.views) {
    if (other.sensor != added.sensor) continue;
    if (same_corners(other, added)) {
      result.left_out.push_back(
          fmt::format("{}: left out, it is the same picture as {}", added.image, other.image));
      return false;
    }
    for (std::size_t p = 0; p < added.stripes.size(); ++p) {
      if (added.stripes[p].empty() || !same_points(added.stripes[p], other.stripes[p])) continue;
      added.stripes[p].clear();
      result.left_out.push_back(fmt::format(
          "{}: stripe left out, its laser picture is the same as that of {}", added.image, other.image));
    }
  }
  return true;
}

/// The board on the bed as a pose of its own, and the pictures of known heights over it.
void add_bed(SessionViews& result, const SensorObservations& sensor, int index) {
  auto board = measured(sensor.bed->board, index, result.target, sensor.laser_planes);
  board.pose = pose_index(result.poses, "bed of " + sensor.name);
  for (const auto& height : sensor.bed->heights) {
    SessionView view;
    view.sensor = index;
    view.pose = board.pose;
    view.image = height.image;
    view.corners.assign(board.corners.size(), unseen_corner());
    view.stripes.resize(static_cast<std::size_t>(sensor.laser_planes));
    view.height_mm = height.height_mm;
    view.lines = height.lines;
    result.views.push_back(std::move(view));
  }
  result.views.push_back(std::move(board));
}

void add_sensor(SessionViews& result, const SensorObservations& sensor, int index) {
  const bool camera_is_known = sensor.given_camera && sensor.given_camera->fixed;
  if (static_cast<int>(sensor.views.size()) < kMinViews && !(sensor.bed && camera_is_known))
    throw NotUsable(
        fmt::format("sensor {}: the board was found in {} only; at least {} are needed, take 15 to 30 "
                    "with the board tilted by 20 to 45 degrees to different sides",
                    sensor.name, counted(sensor.views.size(), "image"), kMinViews));
  result.sensor_names.push_back(sensor.name);
  result.image_sizes.push_back({sensor.width, sensor.height});
  result.given_cameras.push_back(sensor.given_camera);
  for (const auto& view : sensor.views) {
    auto added = measured(view, index, result.target, sensor.laser_planes);
    added.pose = pose_index(result.poses, view.pose);
    for (const auto& other : result.views)
      LIGHTSTRIPE_CHECK(other.sensor != index || other.pose != added.pose,
                        "two views of sensor " + sensor.name + " have the pose " + view.pose);
    if (seen_once(result, added)) result.views.push_back(std::move(added));
  }
  if (sensor.bed) add_bed(result, sensor, index);
}

void add_motion(SessionViews& result, const MotionObservations& motion) {
  LIGHTSTRIPE_CHECK(motion.views.size() == motion.travel.size(), "every motion view needs its travel");
  LIGHTSTRIPE_CHECK(motion.sensor >= 0 && motion.sensor < static_cast<int>(result.sensor_names.size()),
                    "the motion's sensor does not exist");
  result.motion = motion.type;
  result.motion_sensor = motion.sensor;
  result.moves = motion.moves;
  for (std::size_t i = 0; i < motion.views.size(); ++i) {
    auto added = measured(motion.views[i], motion.sensor, result.target, 0);
    added.travel = motion.travel[i] * (motion.type == MotionType::kRotary ? kDegree : 1.0);
    result.views.push_back(std::move(added));
  }
}

int turned_index(const Target& target, int index, int quarter_turns) {
  int x = index % target.columns, y = index / target.columns;
  for (int i = 0; i < quarter_turns; ++i) {
    const int old_x = x;
    x = target.columns - 1 - y;  // quarter turns are used on square boards only
    y = old_x;
  }
  return y * target.columns + x;
}

/// The quarter turns that map the board onto itself.
std::vector<int> quarter_turns(const Target& target) {
  const bool turns = target.type == TargetType::kCheckerboard || target.type == TargetType::kCircles;
  const bool square = turns && target.columns == target.rows && target.pitch_x == target.pitch_y;
  if (square) return {0, 1, 2, 3};
  if (target.half_turn_symmetric()) return {0, 2};
  return {0};
}

}  // namespace

SessionViews prepare_session_views(const CalibrationObservations& observations) {
  LIGHTSTRIPE_CHECK(!observations.sensors.empty(), "a rig needs a sensor");
  LIGHTSTRIPE_CHECK(observations.target.columns >= 3 && observations.target.rows >= 3 &&
                        observations.target.pitch_x > 0 && observations.target.pitch_y > 0,
                    "the target needs at least 3 x 3 inner corners and a pitch");
  SessionViews result;
  result.target = observations.target;
  for (std::size_t i = 0; i < observations.sensors.size(); ++i)
    add_sensor(result, observations.sensors[i], static_cast<int>(i));
  if (observations.motion && observations.motion->type != MotionType::kNone)
    add_motion(result, *observations.motion);
  return result;
}

void refuse_contradicting_poses(int contradicting, int common) {
  if (contradicting == 0 || 2 * contradicting < common) return;
  throw NotUsable(
      fmt::format("the sensors contradict each other in {} of {} of the board; check that "
                  "pictures with the same text in their names show the same moment",
                  contradicting, counted(common, "common pose")));
}

std::vector<StripePoint> independent_points(const std::vector<StripePoint>& points) {
  constexpr double kMinSpacingPx = 2;  // also where the width is unknown
  std::vector<StripePoint> kept;
  for (const auto& point : points) {
    if (point.flags & kStripeBridged) continue;
    const double spacing_px = std::max(kMinSpacingPx, point.width);
    if (kept.empty() || std::hypot(point.x - kept.back().x, point.y - kept.back().y) >= spacing_px)
      kept.push_back(point);
  }
  return kept;
}

std::vector<std::vector<int>> corner_orders(const Target& target) {
  std::vector<std::vector<int>> orders;
  for (const int turns : quarter_turns(target)) {
    std::vector<int> order;
    order.reserve(static_cast<std::size_t>(target.num_corners()));
    for (int i = 0; i < target.num_corners(); ++i)
      order.push_back(turns == 2 ? target.num_corners() - 1 - i : turned_index(target, i, turns));
    orders.push_back(std::move(order));
  }
  return orders;
}

Rigid3 board_turn(const Target& target, std::size_t k) {
  const auto order = corner_orders(target).at(k);
  const Vector2d origin = target.corner(order[0]), along_x = target.corner(order[1]) - origin;
  const double angle = std::atan2(along_x.y(), along_x.x());
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())),
          {origin.x(), origin.y(), 0}};
}

std::vector<Vector2d> relisted(const std::vector<Vector2d>& corners, const std::vector<int>& order) {
  std::vector<Vector2d> result;
  result.reserve(order.size());
  for (const int index : order) result.push_back(corners[static_cast<std::size_t>(index)]);
  return result;
}

}  // namespace lightstripe
