// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One joint bundle adjustment: corners and stripe points of all sensors against all unknowns of the rig.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/adjust/joint_problem.h"
#include "calib/adjust/rig_state.h"
#include "calib/calibration.h"

namespace lightstripe {

struct JointAdjustment {
  RigState state;
  std::vector<Residual> residuals;  ///< with residuals; those not `used` were outliers
  int iterations = 0;
  bool converged = false;
  std::vector<LensModel> lenses;  ///< for each sensor
  double sigma0 = 1;              ///< rms of the normalised residuals / sqrt(1 - unknowns / residuals)
  std::vector<GlobalBlock> globals;
  Eigen::MatrixXd
      covariance;        ///< of the shared unknowns (tangent space), sigma0^2 included; empty if singular
  double condition = 0;  ///< of the shared unknowns' normal matrix, columns scaled to one
};

/// Rounds of Levenberg-Marquardt: robust with the sigmas given; robust with sigmas estimated by the residuals
/// of each sensor's corners and stripes; outliers removed, least squares with final sigmas. Same input, same
/// bits.
/// `lenses`: one for each sensor, none of them kAuto; terms that they do not have start and stay at 0.
JointAdjustment adjust_jointly(const SessionViews& session, const RigState& start,
                               const std::vector<LensModel>& lenses, const CalibrationOptions& options);

}  // namespace lightstripe
