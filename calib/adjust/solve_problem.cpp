// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/solve_problem.h"

namespace lightstripe {

ceres::Solver::Summary solve_problem(JointProblem& joint, int max_iterations, double tolerance) {
  ceres::Solver::Options options;
  const bool shared = joint.num_globals() > 0;
  options.linear_solver_type = shared ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
  options.num_threads = 1;  // more would add in the order of arrival: other bits in every run
  options.max_num_iterations = max_iterations;
  options.function_tolerance = tolerance;
  options.parameter_tolerance = tolerance;
  options.gradient_tolerance = 1e-14;
  options.initial_trust_region_radius =
      1e10;  // the start is good: full Gauss-Newton steps, damped only if they fail
  options.logging_type = ceres::SILENT;
  if (shared) {
    auto* ordering = new ceres::ParameterBlockOrdering;
    for (double* block : joint.blocks()) ordering->AddElementToGroup(block, 1);
    for (double* block : joint.pose_blocks()) ordering->AddElementToGroup(block, 0);
    options.linear_solver_ordering.reset(ordering);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, &joint.problem(), &summary);
  return summary;
}

}  // namespace lightstripe
