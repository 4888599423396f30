// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the calibration sees: corners and stripe points of boards, sensor by sensor. No files, no images.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/board.h"
#include "core/camera.h"
#include "core/rig.h"
#include "core/stripe.h"
#include "core/transform.h"

namespace lightstripe {

/// A corner that a partial view of the board does not show is NaN, so that every list has the target's order.
inline Eigen::Vector2d unseen_corner() {
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}
inline bool is_seen(const Eigen::Vector2d& corner) { return corner.allFinite(); }

/// Intrinsics that are known beforehand.
struct GivenCamera {
  Camera camera;
  bool fixed = true;  ///< false: start values only
};

/// One board pose seen by one sensor. The same `pose` text in two sensors = the same pose of the board.
struct BoardView {
  std::string image;  ///< for messages
  std::string pose;
  std::vector<Eigen::Vector2d> corners;  ///< px, in the order of Target::corner; see is_seen()
  std::vector<std::vector<StripePoint>>
      stripes;               ///< for each laser plane the points on the board (may be empty)
  bool laser_apart = false;  ///< the stripe was seen in a picture of its own, paired with the board's by name
};

/// The laser on a block or plate whose top lies at a known height over the board on the bed.
struct HeightView {
  std::string image;  ///< for messages
  double height_mm = 0;
  std::vector<std::vector<StripePoint>> lines;  ///< straight lines in the picture, one of them on the top
};

/// One board lying flat on the bed, and pictures of known heights over its surface.
struct BedObservations {
  BoardView board;  ///< without stripes
  std::vector<HeightView> heights;
};

struct SensorObservations {
  std::string name;
  int width = 0, height = 0;  ///< px
  int laser_planes = 1;
  std::vector<BoardView> views;
  std::optional<GivenCamera> given_camera{};
  std::optional<BedObservations> bed{};
};

/// A fixed board seen from known positions of travel.
struct MotionObservations {
  MotionType type = MotionType::kLinear;
  int sensor = 0;
  Moves moves = Moves::kRig;
  std::vector<BoardView> views;
  std::vector<double> travel;  ///< for each view, mm or degrees
};

/// The pose of a robot's or CMM's tool while a board view was taken; the board is fixed in the base.
struct ToolPose {
  std::string pose;  ///< of BoardView
  Rigid3 base_from_tool;
};

struct CalibrationObservations {
  Target target;
  std::vector<SensorObservations> sensors;
  std::optional<MotionObservations> motion;
  std::optional<std::vector<ToolPose>> tool_poses{};  ///< the rig sits on the tool: hand-eye calibration
  Eigen::Vector3d up{0, -1, 0};                       ///< hint, first sensor's camera frame
};

}  // namespace lightstripe
