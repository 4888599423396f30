// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How the boards of a session stood before one sensor: tilt, depth, place in the picture, angle to the laser.
#pragma once

#include <vector>

#include "calib/adjust/joint_adjustment.h"
#include "calib/adjust/rig_state.h"

namespace lightstripe {

struct DepthRange {
  double near_mm = 0, far_mm = 0;  ///< z in the camera's frame; 0, 0: no stripe
};

/// Computed once after the adjustment; the verdict, the weakest direction and the uncertainty map judge it.
struct BoardSpread {
  double tilt_deg = 0;  ///< largest angle between a board and the mean of the boards
  /// For each laser plane, the angles between it and the boards that show its stripe, degrees in 0 .. 90.
  std::vector<std::vector<double>> laser_angles_deg;
  DepthRange stripe_depths;  ///< of the used stripe points, on their laser planes
  /// Diagonal of the part of the image where the used stripe points lie, as a share of the image's diagonal.
  double stripe_coverage = 0;
};

BoardSpread board_spread(const SessionViews& session, const JointAdjustment& adjustment, int sensor);

/// Of every sensor.
std::vector<BoardSpread> board_spreads(const SessionViews& session, const JointAdjustment& adjustment);

}  // namespace lightstripe
