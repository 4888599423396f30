// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The calibrated rig: cameras, laser planes, how they stand to each other and how they move.
// calib makes it, rig.yaml keeps it, reconstruct takes it.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/fields.h"
#include "core/plane.h"
#include "core/section_bends.h"
#include "core/transform.h"

namespace lightstripe {

/// One camera with the laser planes that it sees.
struct Sensor {
  std::string name;
  Camera camera;
  std::vector<Plane> laser_planes;  ///< camera frame, n.X = d with d > 0
  Rigid3 rig_from_camera;
  /// Nearest and farthest depth (z of the camera frame, mm) at which something is measured; 0, 0: not known.
  std::array<double, 2> depth_range_mm{0, 0};
};

enum class MotionType { kNone, kLinear, kRotary };

/// In files a motion that is kNone is left out.
constexpr std::array<EnumName<MotionType>, 2> enum_names(MotionType) {
  return {{{MotionType::kLinear, "linear"}, {MotionType::kRotary, "rotary"}}};
}

/// Who moves while the other stands still.
enum class Moves { kRig, kObject };
constexpr std::array<EnumName<Moves>, 2> enum_names(Moves) {
  return {{{Moves::kRig, "rig"}, {Moves::kObject, "object"}}};
}
/// +1 where the rig moves by the travel, -1 where the object does.
constexpr double sign_of(Moves moves) { return moves == Moves::kRig ? 1.0 : -1.0; }
constexpr Moves other(Moves moves) { return moves == Moves::kRig ? Moves::kObject : Moves::kRig; }

/// How rig and object move against each other, in the rig frame.
struct Motion {
  MotionType type = MotionType::kNone;
  Moves moves = Moves::kRig;                                  ///< the object: p = p_seen - s * x
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();       ///< linear
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();       ///< rotary, mm
  Eigen::Vector3d axis_direction = Eigen::Vector3d::UnitY();  ///< rotary, unit
};

struct SensorQuality {
  std::string name;
  double board_rms_px = 0;
  double stripe_rms_px = 0;
  int board_views = 0;
  int stripe_views = 0;
};

/// How far the rig can be trusted; empty where it is not known (a rig written by hand).
struct RigQuality {
  std::vector<SensorQuality> sensors;
  std::map<std::string, double> sigma;  ///< 1-sigma of every parameter by name, e.g. "gauge.camera.fx"
  double section_shape_sigma_mm =
      0;  ///< predicted, rms over the measuring area, after a rigid move; 0 = unknown
  double section_absolute_sigma_mm = 0;         ///< predicted, rms over the measuring area; 0 = unknown
  std::optional<SectionBends> section_bends{};  ///< the errors that section_shape_sigma_mm sums up
  /// Sections by two halves of the views: difference over prediction; empty where it was not computed.
  std::optional<double> cross_validation_ratio;
  std::string weakest;  ///< the least certain direction, in words
  std::vector<std::string> warnings;
};

struct Rig {
  std::vector<Sensor> sensors;
  Motion motion;
  std::optional<Rigid3> tool_from_rig{};  ///< where the rig sits on a robot's or CMM's tool, if it does
  RigQuality quality;
};

/// The rotation rig_from_camera whose x is `x_cam` (travel) and whose z is the `up_cam` hint made orthogonal
/// to it; y = z cross x. Both vectors in the first sensor's camera frame; they must not be parallel.
Eigen::Quaterniond rig_rotation(const Eigen::Vector3d& x_cam, const Eigen::Vector3d& up_cam);

}  // namespace lightstripe
