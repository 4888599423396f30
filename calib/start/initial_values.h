// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Start values for the joint adjustment, stage by stage. Each stage throws NotUsable where the views cannot
// determine what it looks for, leaves out views that contradict the others and says so in `warnings`.
#pragma once

#include <string>
#include <vector>

#include "calib/adjust/rig_state.h"

namespace lightstripe {

/// What is known so far; the stages fill `state` one part after the other.
struct InitialValues {
  SessionViews session;
  std::vector<Rigid3> cam_from_board;  ///< for each view of `session`, in the camera of its sensor
  RigState state;
  std::vector<std::string> warnings;
};

/// All stages in their order.
InitialValues initial_values(SessionViews session);

/// Intrinsics and board poses of every sensor on its own (Zhang 2000, cv::calibrateCamera with k1 k2 p1 p2);
/// fills state.sensors[].camera and cam_from_board.
void start_cameras(InitialValues& values);

/// Sensor-to-sensor transforms as the medoid over common poses, chained from the first sensor; resolves the
/// turns of boards that look the same from several sides; fills state.sensors[].cam_from_first and
/// state.first_from_board.
void link_sensors(InitialValues& values);

/// Laser planes through the rays' meeting points with the boards, by the pair of views that most views agree
/// with.
void start_laser_planes(InitialValues& values);

/// Direction of travel from the board's positions, or the axis of rotation from its poses.
void start_motion(InitialValues& values);

/// Keeps the views whose flag is set.
void keep_views(InitialValues& values, const std::vector<bool>& keep);

}  // namespace lightstripe
