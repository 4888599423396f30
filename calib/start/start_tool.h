// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where the rig sits on a robot's tool, before the tool's poses join the adjustment.
#pragma once

#include <vector>

#include "calib/adjust/adjust_with_tool.h"
#include "calib/observations.h"

namespace lightstripe {

/// find_hand_eye() over the adjusted boards that the tool's poses know; throws NotUsable as it does.
ToolPoses start_tool(const std::vector<ToolPose>& poses, const SessionViews& session, const RigState& state);

}  // namespace lightstripe
