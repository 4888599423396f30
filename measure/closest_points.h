// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The inner step of a registration: feet of the perpendiculars, weights, one Gauss-Newton step.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "measure/coarse_pose.h"

namespace lightstripe {

/// Which zones may count.
using ZoneMask = std::array<bool, kZones>;

struct FitPoint {
  Eigen::Vector2d position;  ///< on the reference
  Eigen::Vector2d normal;
  double residual = 0;  ///< signed distance, mm, + outside
  double weight = 0;
  Zone zone = Zone::kRunning;
  double prior = 1;  ///< weight of the section's point
  int index = 0;     ///< in the section
};

/// Points of the section with a counterpart within reach, all zones, weight 0. Every `step`-th point.
std::vector<FitPoint> find_counterparts(const Section& section, const SectionPose& pose,
                                        const ReferenceShape& reference, int step = 1);

/// Tukey's weights at 1.4826 times the median residual of the masked zones, within [floor, cap]; 0 elsewhere.
void weigh(std::vector<FitPoint>& points, const ZoneMask& mask, double floor_mm, double cap_mm);

struct NormalEquations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double weight = 0, squares = 0;
};
NormalEquations normal_equations(const std::vector<FitPoint>& points);

/// The pose after the step that the equations ask for (turn about the reference's origin, then shift);
/// directions that the points do not hold are left alone; `upright`: no turn. Returns the largest movement of
/// a point 100 mm from the origin.
double apply_step(const NormalEquations& equations, bool upright, SectionPose& pose);

}  // namespace lightstripe
