// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How far a robot's poses scatter, told from how far the pictures' do.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/adjust/joint_problem.h"

namespace lightstripe {

/// The residual of one tool's pose: turn, then shift.
struct ToolResidual {
  std::size_t tool = 0;               ///< of ProblemOptions::tool_poses
  Eigen::Matrix<double, 6, 1> error;  ///< rad, mm
  /// 1: nothing of it is taken by the board's pose, which follows its tool as far as the pictures let it.
  Eigen::Matrix<double, 6, 1> redundancy;
};

/// After a solve with this spread.
std::vector<ToolResidual> tool_residuals(JointProblem& joint, const ToolSpread& spread);

/// The spread that these residuals show (variance components, Förstner 1979: squares over redundancy; robust:
/// by the median). The two poses of the tool take their share of all of
/// them. A component whose residuals the boards take nearly whole keeps its spread: nothing tells it.
ToolSpread estimated_spread(const std::vector<ToolResidual>& residuals, const ToolSpread& so_far,
                            bool robust);

/// Whether the pose contradicts the others by more than `limit` sigma of a component.
bool contradicts(const ToolResidual& residual, const ToolSpread& spread, double limit);

}  // namespace lightstripe
