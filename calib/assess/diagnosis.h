// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a finished calibration tells about itself, for people and for the report.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/adjust/joint_adjustment.h"
#include "calib/assess/board_spread.h"
#include "calib/assess/uncertainty.h"
#include "calib/calibration.h"

namespace lightstripe {

/// Residuals of every corner and stripe point, outliers too.
std::vector<ResidualSample> residual_samples(const SessionViews& session, const JointAdjustment& adjustment);

/// A grid over each sensor's image where its laser planes lie between `near_mm` and `far_mm` of depth (0, 0:
/// where boards showed stripes and a little beyond).
std::vector<UncertaintyCell> uncertainty_map(const SessionViews& session, const JointAdjustment& adjustment,
                                             const std::vector<BoardSpread>& spreads,
                                             const Eigen::Vector3d& up, double near_mm, double far_mm);

CrossValidation cross_validate(const SessionViews& session, const JointAdjustment& adjustment,
                               const Eigen::Vector3d& up, const CalibrationOptions& options);

/// The largest principal part of the section's predicted error, and which views would reduce it.
std::string weakest_direction(const SessionViews& session, const JointAdjustment& adjustment,
                              const std::vector<BoardSpread>& spreads, const SectionErrors& errors,
                              const Eigen::Vector3d& up);

/// For each sensor the share of 8 x 6 equal parts of its image in which a corner was used.
std::vector<double> corner_coverage(const SessionViews& session, const JointAdjustment& adjustment);

/// All of it.
CalibrationDiagnosis diagnose(const SessionViews& session, const JointAdjustment& adjustment,
                              const std::vector<BoardSpread>& spreads, const SectionErrors& errors,
                              const Eigen::Vector3d& up, const CalibrationOptions& options);

}  // namespace lightstripe
