// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The poses of a robot's tool among the measurements of the joint adjustment.
#pragma once

#include <string>
#include <vector>

#include "calib/adjust/joint_adjustment.h"

namespace lightstripe {

/// What a controller says of its tool, and where the unknowns of it start.
struct ToolPoses {
  ToolState start;
  std::vector<ToolMeasurement> poses;
  ToolSpread spread;  ///< a first idea
};

struct ToolAdjustment {
  JointAdjustment adjustment;
  std::vector<std::string> left_out;  ///< poses that contradict the others, as sentences
};

/// The adjustment once more: the tool's poses tell of the cameras what the pictures tell of the tool. From
/// `before` with its sigmas and without its outliers; robust rounds give the spread of the tool's poses,
/// those that contradict are left out, then least squares.
ToolAdjustment adjust_with_tool(const SessionViews& session, const JointAdjustment& before,
                                const ToolPoses& tool, const CalibrationOptions& options);

}  // namespace lightstripe
