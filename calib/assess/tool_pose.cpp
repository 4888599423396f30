// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/tool_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/assess/uncertainty.h"
#include "calib/start/board_pose.h"

namespace lightstripe {
namespace {

/// A view of the tool and the picture of the first sensor in which the board was seen.
struct SeenTool {
  ToolView view;
  const SessionView* picture = nullptr;  ///< null: other sensors saw the board
};

std::vector<SeenTool> seen_tools(const std::vector<ToolPose>& poses, const SessionViews& session,
                                 const JointAdjustment& adjustment) {
  std::vector<SeenTool> seen;
  for (const ToolPose& tool : poses) {
    const auto pose = std::find(session.poses.begin(), session.poses.end(), tool.pose);
    const auto index = static_cast<int>(pose - session.poses.begin());
    const auto shows_it = [&](const SessionView& view) { return view.pose == index; };
    if (pose == session.poses.end() || std::none_of(session.views.begin(), session.views.end(), shows_it))
      continue;
    const auto by_first = std::find_if(
        session.views.begin(), session.views.end(),
        [&](const SessionView& view) { return shows_it(view) && view.sensor == 0 && !view.height_mm; });
    seen.push_back(
        {{tool.pose, tool.base_from_tool, adjustment.state.first_from_board[static_cast<std::size_t>(index)]},
         by_first == session.views.end() ? nullptr : &*by_first});
  }
  return seen;
}

std::vector<ToolView> views_of(const std::vector<SeenTool>& seen) {
  std::vector<ToolView> views;
  for (const auto& one : seen) views.push_back(one.view);
  return views;
}

/// The same with the boards' poses as this camera sees them.
std::vector<ToolView> seen_by(const Camera& camera, const Target& target, const std::vector<SeenTool>& seen) {
  auto views = views_of(seen);
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i].picture != nullptr)
      if (const auto pose = board_pose(camera, target, seen[i].picture->corners))
        views[i].first_from_board = *pose;
  return views;
}

/// Rotation vector from a mean (rad) and translation (mm).
Eigen::VectorXd as_vector(const Rigid3& tool_from_first, const Rigid3& mean) {
  const Eigen::AngleAxisd turn(tool_from_first.rotation * mean.rotation.conjugate());
  Eigen::VectorXd out(6);
  out << turn.angle() * turn.axis(), tool_from_first.translation;
  return out;
}

}  // namespace

HandEye find_tool(const std::vector<ToolPose>& poses, const SessionViews& session,
                  const JointAdjustment& adjustment) {
  const auto seen = seen_tools(poses, session, adjustment);
  HandEye found = find_hand_eye(views_of(seen));
  found.covariance += covariance_of(adjustment, [&](const RigState& state) {
    return as_vector(
        find_hand_eye(seen_by(state.sensors.front().camera, session.target, seen)).tool_from_first,
        found.tool_from_first);
  });
  constexpr double kDegree = std::numbers::pi / 180;
  found.rotation_sigma_deg = std::sqrt(found.covariance.topLeftCorner<3, 3>().trace()) / kDegree;
  found.translation_sigma_mm = std::sqrt(found.covariance.bottomRightCorner<3, 3>().trace());
  return found;
}

}  // namespace lightstripe
