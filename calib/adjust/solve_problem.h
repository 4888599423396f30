// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How this module solves its problems: Levenberg-Marquardt, poses eliminated, one thread, same input -> same
// bits.
#pragma once

#include <ceres/solver.h>

#include "calib/adjust/joint_problem.h"

namespace lightstripe {

ceres::Solver::Summary solve_problem(JointProblem& joint, int max_iterations, double tolerance);

}  // namespace lightstripe
