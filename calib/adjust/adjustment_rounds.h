// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What every round of an adjustment does: build the problem from the state so far, solve it, read what is
// left.
#pragma once

#include <vector>

#include "calib/adjust/joint_adjustment.h"
#include "calib/adjust/tool_spread.h"

namespace lightstripe {

inline constexpr double kRoughTolerance = 1e-8, kFinalTolerance = 1e-11;

struct AdjustmentRounds {
  const SessionViews& session;
  const CalibrationOptions& options;
  JointAdjustment result;
  double redundancy = 1;  ///< of the last solve
  std::vector<ToolMeasurement> tool_poses{};
  ToolSpread tool_spread{};
  bool robust_tool = false;           ///< Cauchy's loss on the tool's poses
  std::vector<ToolResidual> tools{};  ///< of the last solve

  /// Solves with this loss from the state so far; false where Ceres found no usable step. With `covariance`
  /// the shared unknowns' covariance is taken at the end.
  bool solve(ProblemOptions::Loss loss, double tolerance, bool covariance = false);
};

}  // namespace lightstripe
