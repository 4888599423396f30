// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/rig_state.h"

#include <cmath>
#include <numbers>

namespace lightstripe {

using Eigen::Vector3d;

Vector3d moved(const MotionState& motion, MotionType type, double signed_travel, const Vector3d& p_first) {
  if (type == MotionType::kRotary)
    return motion.axis_point +
           Eigen::AngleAxisd(signed_travel, motion.direction) * (p_first - motion.axis_point);
  return p_first + signed_travel * motion.direction;
}

std::optional<StripeLine> stripe_line(const Plane& board, const Plane& laser) {
  const Vector3d across = board.normal.cross(laser.normal);
  const double sine = across.norm();
  if (sine < std::sin(0.5 * std::numbers::pi / 180)) return std::nullopt;
  const Vector3d direction = across / sine;
  // The point of both planes nearest to the origin: in the span of the two normals.
  const Vector3d point =
      (board.offset * laser.normal.cross(across) - laser.offset * board.normal.cross(across)) / (sine * sine);
  return StripeLine{point, direction};
}

Plane board_plane(const Rigid3& cam_from_board) {
  const Vector3d normal = cam_from_board.rotation * Vector3d::UnitZ();
  return canonical({normal, normal.dot(cam_from_board.translation)});
}

}  // namespace lightstripe
