// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/tool_spread.h"

#include <ceres/crs_matrix.h>

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using RowMajor6 = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

constexpr double kLeastRotation = 1e-6, kLeastTranslationMm = 1e-3;  // no controller is better
constexpr double kLeastRedundancy = 0.05;

/// The tool's six residuals beside one board, and what its pose takes of them.
ToolResidual seen_beside(ceres::Problem& problem, std::size_t index, ceres::ResidualBlockId tool,
                         const ToolSpread& spread) {
  std::vector<double*> blocks;
  problem.GetParameterBlocksForResidualBlock(tool, &blocks);
  ceres::Problem::EvaluateOptions options;
  options.apply_loss_function = false;
  options.parameter_blocks = {blocks.front()};
  problem.GetResidualBlocksForParameterBlock(blocks.front(), &options.residual_blocks);
  auto& ids = options.residual_blocks;
  ids.erase(std::find(ids.begin(), ids.end(), tool));
  ids.push_back(tool);
  std::vector<double> residuals;
  ceres::CRSMatrix crs;
  problem.Evaluate(options, nullptr, &residuals, nullptr, &crs);
  const Eigen::Map<const RowMajor6> J(crs.values.data(), crs.num_rows, 6);  // one block: its rows are full
  const Eigen::Matrix<double, 6, 6> of_tool = J.bottomRows<6>(), normal = J.transpose() * J;
  const Eigen::Matrix<double, 6, 6> taken = of_tool * solve_symmetric(normal, of_tool.transpose());
  Vector6d error = Eigen::Map<const Vector6d>(residuals.data() + residuals.size() - 6);
  error.head<3>() *= spread.rotation;
  error.tail<3>() *= spread.translation;
  return {index, error, (Vector6d::Ones() - taken.diagonal()).cwiseMax(0)};
}

/// Of an error as if no board took of it; 0 where nothing can be told.
double whole(const ToolResidual& one, Eigen::Index k) {
  return one.redundancy[k] > kLeastRedundancy ? std::abs(one.error[k]) / std::sqrt(one.redundancy[k]) : 0;
}

/// The spread of the components first .. first + 2.
double spread_of(const std::vector<ToolResidual>& residuals, Eigen::Index first, bool robust, double so_far) {
  std::vector<double> amounts;
  double squares = 0, free = 0;
  for (const auto& one : residuals)
    for (Eigen::Index k = first; k < first + 3; ++k) {
      amounts.push_back(whole(one, k));
      squares += one.error[k] * one.error[k];
      free += one.redundancy[k];
    }
  const auto n = static_cast<double>(amounts.size());
  const double share = std::max(0.1, 1 - 6 / n);  // six unknowns of each kind
  if (free < kLeastRedundancy * n) return so_far;
  return robust ? kMadToSigma * upper_median(amounts) / std::sqrt(share)
                : std::sqrt(squares / (free * share));
}

}  // namespace

std::vector<ToolResidual> tool_residuals(JointProblem& joint, const ToolSpread& spread) {
  std::vector<ToolResidual> residuals;
  const auto& ids = joint.tool_residuals();
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (ids[i] != nullptr) residuals.push_back(seen_beside(joint.problem(), i, ids[i], spread));
  return residuals;
}

ToolSpread estimated_spread(const std::vector<ToolResidual>& residuals, const ToolSpread& so_far,
                            bool robust) {
  if (residuals.empty()) return so_far;
  return {std::max(kLeastRotation, spread_of(residuals, 0, robust, so_far.rotation)),
          std::max(kLeastTranslationMm, spread_of(residuals, 3, robust, so_far.translation))};
}

bool contradicts(const ToolResidual& residual, const ToolSpread& spread, double limit) {
  const auto length = [&](Eigen::Index first) {
    return std::hypot(whole(residual, first), whole(residual, first + 1), whole(residual, first + 2));
  };
  const double limit_of_length = limit * std::sqrt(3.0);
  return length(0) > limit_of_length * spread.rotation || length(3) > limit_of_length * spread.translation;
}

}  // namespace lightstripe
