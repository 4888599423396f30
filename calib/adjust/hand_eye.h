// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where the rig sits on a robot's tool: a fixed board seen from known poses of the tool.
#pragma once

#include <string>
#include <vector>

#include "calib/adjust/tool_pose_error.h"
#include "core/transform.h"

namespace lightstripe {

/// One board picture with the tool's pose, as the controller says it, and the board's, as the camera sees it.
struct ToolView {
  std::string image;
  Rigid3 base_from_tool;
  Rigid3 first_from_board;  ///< first sensor's camera frame
};

struct HandEye {
  Rigid3 tool_from_first, base_from_board;
  double rotation_rms_deg = 0;    ///< of the tool's poses against the board's; length of the rotation vector
  double translation_rms_mm = 0;  ///< length
  ToolSpread spread;              ///< of the tool's poses against the board's
};

/// Starts by cv::calibrateHandEye (Daniilidis 1999, Tsai and Lenz 1989), then minimises rotation and
/// translation of base_from_tool^-1 (base_from_board board_from_first first_from_tool) over both unknown
/// poses (Ceres; Cauchy, then least squares), each in units of its own spread, which the residuals give.
/// Throws NotUsable where the tool's poses do not move or turn about one axis only, or where they contradict
/// the board's.
HandEye find_hand_eye(const std::vector<ToolView>& views);

}  // namespace lightstripe
