// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/adjust_with_tool.h"

#include <fmt/format.h>

#include "calib/adjust/adjustment_rounds.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

constexpr double kOutlier = 4.5;  // in sigma of a component
constexpr int kSpreadRounds = 3;

bool solve_and_estimate(AdjustmentRounds& rounds, bool robust) {
  rounds.robust_tool = robust;
  if (!rounds.solve(ProblemOptions::Loss::kSquared, kRoughTolerance)) return false;
  rounds.tool_spread = estimated_spread(rounds.tools, rounds.tool_spread, robust);
  return true;
}

/// Takes the contradicting poses out; one sentence each.
std::vector<std::string> leave_out(const SessionViews& session, AdjustmentRounds& rounds) {
  std::vector<std::string> sentences;
  std::vector<ToolMeasurement> kept;
  for (const ToolResidual& one : rounds.tools) {
    const ToolMeasurement& measured = rounds.tool_poses[one.tool];
    if (!contradicts(one, rounds.tool_spread, kOutlier)) {
      kept.push_back(measured);
      continue;
    }
    sentences.push_back(fmt::format(
        "{}: the tool's pose is left out, it is {:.2f} degrees and {:.2f} mm off the others'",
        session.poses[measured.pose], one.error.head<3>().norm() / kDegree, one.error.tail<3>().norm()));
  }
  rounds.tool_poses = kept;
  return sentences;
}

}  // namespace

ToolAdjustment adjust_with_tool(const SessionViews& session, const JointAdjustment& before,
                                const ToolPoses& tool, const CalibrationOptions& options) {
  AdjustmentRounds rounds{session, options, before};
  rounds.tool_poses = tool.poses;
  rounds.tool_spread = tool.spread;
  rounds.result.state.tool = tool.start;
  std::vector<std::string> left_out;
  bool usable = true;
  for (int i = 0; i < kSpreadRounds && usable; ++i) usable = solve_and_estimate(rounds, true);
  if (usable) left_out = leave_out(session, rounds);
  for (int i = 0; i < kSpreadRounds && usable; ++i) usable = solve_and_estimate(rounds, false);
  if (usable) rounds.solve(ProblemOptions::Loss::kSquared, kFinalTolerance, true);
  return {std::move(rounds.result), std::move(left_out)};
}

}  // namespace lightstripe
