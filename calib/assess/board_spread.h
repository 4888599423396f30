// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How the boards of a session stood: tilt, depth, angle to the laser.
#pragma once

#include <vector>

#include "calib/adjust/joint_problem.h"
#include "calib/adjust/rig_state.h"

namespace lightstripe {

/// The largest angle between a board of the sensor and the mean of its boards, degrees.
double tilt_spread_deg(const SessionViews& measurements, const RigState& state, int sensor);

/// The angles between the sensor's boards and one of its laser planes, degrees in 0 .. 90, of the views that
/// show its stripe.
std::vector<double> laser_angles_deg(const SessionViews& measurements, const RigState& state, int sensor,
                                     std::size_t plane);

struct DepthRange {
  double near_mm = 0, far_mm = 0;  ///< z in the camera's frame; 0, 0: no stripe
};

/// Depths of the used stripe points, on their laser planes.
DepthRange stripe_depths(const SessionViews& measurements, const RigState& state,
                         const std::vector<Residual>& list, int sensor);

/// Diagonal of the part of the image where the sensor's used stripe points lay, as a share of the image's
/// diagonal.
double stripe_coverage(const SessionViews& measurements, const std::vector<Residual>& list, int sensor);

}  // namespace lightstripe
