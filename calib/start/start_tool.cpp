// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/start_tool.h"

#include <algorithm>

#include "calib/adjust/hand_eye.h"

namespace lightstripe {

ToolPoses start_tool(const std::vector<ToolPose>& poses, const SessionViews& session, const RigState& state) {
  std::vector<ToolMeasurement> measured;
  std::vector<ToolView> views;
  for (const ToolPose& tool : poses) {
    const auto found = std::find(session.poses.begin(), session.poses.end(), tool.pose);
    const auto index = found - session.poses.begin();
    if (std::none_of(session.views.begin(), session.views.end(),
                     [&](const SessionView& view) { return view.pose == index; }))
      continue;
    const auto pose = static_cast<std::size_t>(index);
    measured.push_back({pose, tool.base_from_tool});
    views.push_back({tool.pose, tool.base_from_tool, state.first_from_board[pose]});
  }
  const HandEye found = find_hand_eye(views);
  return {{found.tool_from_first, found.base_from_board}, std::move(measured), found.spread};
}

}  // namespace lightstripe
