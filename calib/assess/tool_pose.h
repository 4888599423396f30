// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where the rig sits on a robot's tool, and how certain that is with a camera that was calibrated by the same
// boards.
#pragma once

#include <vector>

#include "calib/adjust/hand_eye.h"
#include "calib/adjust/joint_adjustment.h"
#include "calib/observations.h"

namespace lightstripe {

/// find_hand_eye() over the adjusted boards that the tool's poses know. The sigmas hold what the poses leave
/// open and what the camera's own unknowns do: an error of its principal point turns all boards alike, so
/// that no pose contradicts it. The camera's part: the boards' poses anew for each of its unknowns moved
/// (central differences).
HandEye find_tool(const std::vector<ToolPose>& poses, const SessionViews& session,
                  const JointAdjustment& adjustment);

}  // namespace lightstripe
