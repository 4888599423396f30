// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/adjustment_rounds.h"

#include <algorithm>
#include <cmath>

#include "calib/adjust/reduced_covariance.h"
#include "calib/adjust/solve_problem.h"

namespace lightstripe {
namespace {

/// Stripe points that no ray explains in this state are of no use in the next round.
void drop_unseen(const SessionViews& session, const RigState& state, std::vector<Residual>& list) {
  for (auto& residual : list) {
    if (residual.is_corner() || !residual.used) continue;
    const auto& view = session.views[residual.view];
    const auto p = static_cast<std::size_t>(residual.plane);
    const auto& point = view.stripes[p][residual.index];
    residual.used = seen_stripe_point(session, state, view, p, {point.x, point.y}).has_value();
  }
}

void read_residuals(JointProblem& joint, std::vector<Residual>& list) {
  ceres::Problem::EvaluateOptions options;
  options.apply_loss_function = false;
  std::vector<double> residuals;
  joint.problem().Evaluate(options, nullptr, &residuals, nullptr, nullptr);
  auto next = residuals.cbegin();
  for (auto& residual : list) {
    if (!residual.used) continue;
    for (int i = 0; i < residual.dimension(); ++i) residual.residual_px[i] = *next++ * residual.sigma_px;
  }
}

double redundancy_of(const ceres::Solver::Summary& summary) {
  return std::max(0.1, 1.0 - static_cast<double>(summary.num_effective_parameters_reduced) /
                                 summary.num_residuals_reduced);
}

}  // namespace

bool AdjustmentRounds::solve(ProblemOptions::Loss loss, double tolerance, bool covariance) {
  drop_unseen(session, result.state, result.residuals);
  JointProblem joint(
      session, result.state, result.residuals,
      {result.lenses, options.board_warp, loss, options.robust_scale, tool_poses, tool_spread});
  const auto summary = solve_problem(joint, options.max_iterations, tolerance);
  result.iterations += static_cast<int>(summary.iterations.size());
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  if (!summary.IsSolutionUsable()) return false;
  result.state = joint.state();
  read_residuals(joint, result.residuals);
  redundancy = redundancy_of(summary);
  tools = tool_residuals(joint, tool_spread);
  if (!covariance) return true;
  result.sigma0 = std::sqrt(2 * summary.final_cost / summary.num_residuals_reduced / redundancy);
  result.globals = joint.globals();
  const auto reduced = reduced_covariance(joint);
  result.covariance = result.sigma0 * result.sigma0 * reduced.covariance;
  result.condition = reduced.condition;
  return true;
}

}  // namespace lightstripe
