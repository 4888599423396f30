// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/rig_frame.h"

#include <cmath>
#include <numbers>

namespace lightstripe {
namespace {

Motion motion_in_rig(const SessionViews& session, const MotionState& state, const Rigid3& rig_from_first) {
  Motion motion;
  motion.type = session.motion;
  motion.moves = session.moves;
  if (motion.type != MotionType::kRotary) return motion;  // direction = x by the frame's definition
  motion.axis_point = rig_from_first * nearest_point_of_axis(state);
  motion.axis_direction = rig_from_first.rotation * state.direction;
  if (motion.axis_direction.y() < 0) {
    motion.axis_direction = -motion.axis_direction;
    motion.moves = other(motion.moves);
  }
  return motion;
}

}  // namespace

Rigid3 rig_from_first(const RigState& state, MotionType motion, const Eigen::Vector3d& up) {
  const bool travels = motion == MotionType::kLinear && state.motion;
  const auto& planes = state.sensors.front().laser_planes;
  const Eigen::Vector3d x = travels          ? state.motion->direction
                            : planes.empty() ? Eigen::Vector3d::UnitX()  // cameras only
                                             : planes.front().normal;
  if (up.normalized().cross(x).norm() < std::sin(3 * std::numbers::pi / 180))
    throw NotUsable(
        travels ? "up: the hint is parallel to the direction of travel; give another direction"
                : "up: the hint is parallel to the first laser plane's normal; give another direction");
  return {rig_rotation(x, up), Eigen::Vector3d::Zero()};
}

Eigen::Vector3d nearest_point_of_axis(const MotionState& motion) {
  const Eigen::Vector3d axis = motion.direction.normalized();
  return motion.axis_point - axis.dot(motion.axis_point) * axis;
}

Rig rig_of(const SessionViews& session, const RigState& state, const Eigen::Vector3d& up) {
  const Rigid3 rig_from_first_cam = rig_from_first(state, session.motion, up);
  Rig rig;
  for (std::size_t i = 0; i < state.sensors.size(); ++i) {
    Sensor sensor;
    sensor.name = session.sensor_names[i];
    sensor.camera = state.sensors[i].camera;
    for (const auto& plane : state.sensors[i].laser_planes) sensor.laser_planes.push_back(canonical(plane));
    sensor.rig_from_camera = rig_from_first_cam * state.sensors[i].cam_from_first.inverse();
    rig.sensors.push_back(std::move(sensor));
  }
  if (state.motion) rig.motion = motion_in_rig(session, *state.motion, rig_from_first_cam);
  return rig;
}

}  // namespace lightstripe
