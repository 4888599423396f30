// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The unknowns of the joint adjustment and the views that determine them, sorted by view.
// All poses are in the first sensor's camera frame ("first"), mm.
#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "calib/observations.h"
#include "core/camera.h"
#include "core/plane.h"
#include "core/transform.h"

namespace lightstripe {

struct SensorState {
  Camera camera;
  Rigid3 cam_from_first;            ///< identity for sensor 0, by definition
  std::vector<Plane> laser_planes;  ///< camera frame
};

struct MotionState {
  Rigid3 first_from_board;                               ///< the fixed board at travel 0
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< of travel (linear), of the axis (rotary); unit
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();  ///< rotary
};

/// The rig on a robot's tool, and the board that stands still in the robot's base.
struct ToolState {
  Rigid3 tool_from_first, base_from_board;
};

struct RigState {
  std::vector<SensorState> sensors;
  std::vector<Rigid3> first_from_board;  ///< for each pose of SessionViews::poses
  std::optional<MotionState> motion;
  Eigen::Vector2d board_warp_mm = Eigen::Vector2d::Zero();  ///< see board_surface.h
  std::optional<ToolState> tool{};
};

/// What one image shows. Corners in an order that agrees with the other views of the same pose.
struct SessionView {
  int sensor = 0;
  int pose = -1;      ///< index into SessionViews::poses; -1: the fixed board of the motion
  double travel = 0;  ///< motion views only; mm, or radians
  std::string image;
  bool laser_apart = false;                       ///< the stripe was seen in a picture of its own
  std::vector<Eigen::Vector2d> corners;           ///< px; see is_seen()
  std::vector<std::vector<StripePoint>> stripes;  ///< for each laser plane; thinned to independent points
  /// The laser on a top that lies this high over the pose's board, towards the camera; no corners.
  std::optional<double> height_mm;
  std::vector<std::vector<StripePoint>> lines;  ///< where a height is given: candidates for stripes[0]
};

struct SessionViews {
  Target target;
  std::vector<std::string> sensor_names;
  std::vector<std::array<int, 2>> image_sizes;            ///< px, width and height for each sensor
  std::vector<std::optional<GivenCamera>> given_cameras;  ///< for each sensor
  std::vector<std::string> poses;
  std::vector<SessionView> views;  ///< sensor by sensor, motion views last
  MotionType motion = MotionType::kNone;
  int motion_sensor = 0;
  Moves moves = Moves::kRig;
  /// For each sensor and laser plane: boards that showed a stripe, before any was left out.
  std::vector<std::vector<int>> stripes_found;
  std::vector<std::string> left_out;  ///< views and stripes that were seen twice, one sentence each

  /// p_seen = p + sign * travel * direction: a rig that moves forward sees the board move backward.
  double motion_sign() const { return -sign_of(moves); }
};

/// Thrown inside calib where the observations cannot determine a rig; calibrate_rig turns it into a summary.
/// The text says what is wrong and what to do.
struct NotUsable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Where the fixed board is seen at this travel (mm, or radians), first frame.
Eigen::Vector3d moved(const MotionState& motion, MotionType type, double signed_travel,
                      const Eigen::Vector3d& p_first);

/// Where a laser plane and a board meet.
struct StripeLine {
  Eigen::Vector3d point;      ///< on the line, camera frame, mm
  Eigen::Vector3d direction;  ///< unit
};

/// Nothing where board and laser plane are closer to parallel than 0.5 degrees.
std::optional<StripeLine> stripe_line(const Plane& board, const Plane& laser);

/// The board's plane in the camera frame.
Plane board_plane(const Rigid3& cam_from_board);

}  // namespace lightstripe
