// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/verify/verify_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "calib/adjust/session_views.h"
#include "calib/board/board_map.h"
#include "calib/start/board_pose.h"
#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// What one sensor tells of one pose, in the rig frame.
struct SeenBoard {
  const Sensor* sensor = nullptr;
  Rigid3 rig_from_board;
  std::vector<Vector3d> stripe;  ///< points of all its laser planes
};

const Sensor& sensor_of(const Rig& rig, const std::string& name) {
  const auto found =
      std::find_if(rig.sensors.begin(), rig.sensors.end(), [&](const auto& s) { return s.name == name; });
  LIGHTSTRIPE_CHECK(found != rig.sensors.end(), "the rig has no sensor " + name);
  return *found;
}

/// Slope of the triangulated place along the stripe over that on the board, less 1, times the length.
void measure_length(const std::vector<Vector3d>& measured, const std::vector<Vector2d>& on_board,
                    VerifiedView& view) {
  const auto n = static_cast<double>(measured.size());
  Vector3d mean_3d = Vector3d::Zero();
  Vector2d mean_2d = Vector2d::Zero();
  for (std::size_t i = 0; i < measured.size(); ++i) {
    mean_3d += measured[i] / n;
    mean_2d += on_board[i] / n;
  }
  const Vector2d along_2d = (on_board.back() - on_board.front()).normalized();
  const Vector3d along_3d = (measured.back() - measured.front()).normalized();
  double both = 0, square = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double s = along_2d.dot(on_board[i] - mean_2d);
    both += s * along_3d.dot(measured[i] - mean_3d);
    square += s * s;
  }
  view.length_mm = (on_board.back() - on_board.front()).norm();
  view.length_error_mm = square > 0 ? (both / square - 1) * view.length_mm : 0;
}

/// Fills the mm of one laser plane's stripe; returns its points in the camera frame.
std::vector<Vector3d> measure_stripe(const std::vector<StripePoint>& stripe, const Sensor& sensor,
                                     std::size_t plane, const Rigid3& cam_from_board,
                                     const std::optional<BoardMap>& map, VerifiedView& view) {
  const Rigid3 board_from_cam = cam_from_board.inverse();
  std::vector<Vector3d> points;
  std::vector<Vector2d> on_board;
  double sum = 0, squares = 0;
  for (const auto& point : independent_points(stripe)) {
    const auto ray = unproject(sensor.camera, {point.x, point.y});
    const auto p = ray ? intersect(sensor.laser_planes[plane], Vector3d::Zero(), *ray) : std::nullopt;
    if (!p) continue;
    const double distance = (board_from_cam * *p).z();
    sum += distance;
    squares += distance * distance;
    view.plane_max_mm = std::max(view.plane_max_mm, std::abs(distance));
    points.push_back(*p);
    if (map) on_board.push_back((*map)({point.x, point.y}));
  }
  view.stripe_points = static_cast<int>(points.size());
  if (points.empty()) return points;
  view.plane_mean_mm = sum / static_cast<double>(points.size());
  view.plane_rms_mm = std::sqrt(squares / static_cast<double>(points.size()));
  if (map && points.size() > 2) measure_length(points, on_board, view);
  return points;
}

SeenBoard verify_view(const BoardView& seen, const Sensor& sensor, const Target& target,
                      const Rigid3& cam_from_board, Verification& result) {
  SeenBoard board{&sensor, sensor.rig_from_camera * cam_from_board, {}};
  const bool complete = std::all_of(seen.corners.begin(), seen.corners.end(), is_seen);
  const auto map = complete ? fit_board_map(seen.corners, target) : std::nullopt;
  VerifiedView view;
  view.sensor = sensor.name;
  view.pose = seen.pose;
  view.image = seen.image;
  view.corners = static_cast<int>(std::count_if(seen.corners.begin(), seen.corners.end(), is_seen));
  view.corner_rms_px = corner_rms_px(sensor.camera, target, cam_from_board, seen.corners);
  const std::size_t planes = std::min(seen.stripes.size(), sensor.laser_planes.size());
  for (std::size_t p = 0; p < std::max<std::size_t>(1, planes); ++p) {
    VerifiedView of_plane = view;
    of_plane.laser_plane = static_cast<int>(p);
    if (p < planes)
      for (const auto& point : measure_stripe(seen.stripes[p], sensor, p, cam_from_board, map, of_plane))
        board.stripe.push_back(sensor.rig_from_camera * point);
    result.views.push_back(of_plane);
  }
  return board;
}

/// Mean signed distance of the points to the board's plane.
double mean_height(const std::vector<Vector3d>& points, const Rigid3& rig_from_board) {
  const Rigid3 board_from_rig = rig_from_board.inverse();
  double sum = 0;
  for (const auto& p : points) sum += (board_from_rig * p).z();
  return sum / static_cast<double>(points.size());
}

/// The middle is the same however the corners of a symmetric board are listed.
Vector3d middle_of(const Target& target, const Rigid3& rig_from_board) {
  return rig_from_board * Vector3d(target.middle().x(), target.middle().y(), 0);
}

VerifiedPair compare(const SeenBoard& a, const SeenBoard& b, const std::string& pose, const Target& target) {
  VerifiedPair pair{a.sensor->name, b.sensor->name, pose, std::nullopt, 0};
  pair.centre_gap_mm = (middle_of(target, a.rig_from_board) - middle_of(target, b.rig_from_board)).norm();
  if (!a.stripe.empty() && !b.stripe.empty())
    pair.gap_mm = mean_height(b.stripe, a.rig_from_board) - mean_height(a.stripe, a.rig_from_board);
  return pair;
}

/// A point seen at a travel (mm, degrees), brought back to travel 0; see docs/conventions.md, "Travel".
Vector3d at_travel_0(const Motion& motion, double travel, const Vector3d& p) {
  const double s = sign_of(motion.moves) * travel;
  if (motion.type == MotionType::kLinear) return p + s * motion.direction;
  const Eigen::AngleAxisd turn(s * std::acos(-1.0) / 180, motion.axis_direction);
  return motion.axis_point + turn * (p - motion.axis_point);
}

std::optional<double> travel_rms(const MotionObservations& seen, const CalibrationObservations& observations,
                                 const Rig& rig) {
  if (rig.motion.type != seen.type) return std::nullopt;
  const Sensor& sensor = sensor_of(rig, observations.sensors[static_cast<std::size_t>(seen.sensor)].name);
  std::vector<Vector3d> middles;
  for (std::size_t i = 0; i < seen.views.size(); ++i) {
    const auto pose = board_pose(sensor.camera, observations.target, seen.views[i].corners);
    if (pose)
      middles.push_back(at_travel_0(rig.motion, seen.travel[i],
                                    middle_of(observations.target, sensor.rig_from_camera * *pose)));
  }
  if (middles.size() < 2) return std::nullopt;
  Vector3d mean = Vector3d::Zero();
  for (const auto& p : middles) mean += p / static_cast<double>(middles.size());
  double sum = 0;
  for (const auto& p : middles) sum += (p - mean).squaredNorm();
  return std::sqrt(sum / static_cast<double>(middles.size()));
}

}  // namespace

Verification verify_rig(const CalibrationObservations& observations, const Rig& rig) {
  Verification result;
  std::map<std::string, std::vector<SeenBoard>> by_pose;
  for (const auto& seen : observations.sensors) {
    const Sensor& sensor = sensor_of(rig, seen.name);
    for (const auto& view : seen.views) {
      const auto pose = board_pose(sensor.camera, observations.target, view.corners);
      if (pose) by_pose[view.pose].push_back(verify_view(view, sensor, observations.target, *pose, result));
    }
  }
  for (const auto& [pose, boards] : by_pose)
    for (std::size_t a = 0; a < boards.size(); ++a)
      for (std::size_t b = a + 1; b < boards.size(); ++b)
        result.pairs.push_back(compare(boards[a], boards[b], pose, observations.target));
  if (observations.motion) result.travel_rms_mm = travel_rms(*observations.motion, observations, rig);
  return result;
}

}  // namespace lightstripe
