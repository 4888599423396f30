// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Covariance of the shared unknowns: normal equations with the poses eliminated (Schur complement), inverted
// by their eigenvalues so that a direction the data leave open is seen and not divided by.
#pragma once

#include <Eigen/Core>

#include "calib/adjust/joint_problem.h"

namespace lightstripe {

struct ReducedCovariance {
  Eigen::MatrixXd covariance;  ///< for residuals of unit variance; empty where the normal matrix is singular
  double condition = 0;        ///< largest / smallest eigenvalue, unknowns scaled to a diagonal of ones
};

ReducedCovariance reduced_covariance(JointProblem& joint);

}  // namespace lightstripe
