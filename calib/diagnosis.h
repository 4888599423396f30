// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a finished calibration tells about itself, for people and for the report.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/joint_adjustment.h"

namespace lightstripe {

/// One corner or stripe point with its residual (seen by the model - measured).
struct ResidualSample {
  int view = 0;  ///< index in CalibrationSummary::views
  bool corner = true;
  bool used = true;  ///< false: an outlier, beyond CalibrationOptions::outlier_sigma
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  ///< of a stripe point across the stripe, sign in x
  double normalised = 0;                                  ///< length / sigma
};

/// Predicted 1-sigma error of a point of the section.
struct UncertaintyCell {
  int sensor = 0, plane = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d section_mm = Eigen::Vector2d::Zero();  ///< y, z of the rig frame
  double absolute_mm = 0;
  double shape_mm = 0;        ///< after the best rigid move of all cells that are not extrapolated
  bool extrapolated = false;  ///< no board showed a stripe near it
};

/// The calibration by every other pose against that by the rest: section shapes, mm rms.
struct CrossValidation {
  bool done = false;
  std::string why_not;  ///< where it could not be done
  double difference_mm = 0;
  double predicted_mm = 0;  ///< what the two covariances let expect
  double ratio() const { return predicted_mm > 0 ? difference_mm / predicted_mm : 0; }
};

struct CalibrationDiagnosis {
  std::vector<ResidualSample> residuals;
  std::vector<UncertaintyCell> map;
  CrossValidation cross_validation;
  std::string weakest;                  ///< the least certain direction, in words
  std::vector<Rigid3> rig_from_board;   ///< the board's poses; rig frame
  std::vector<std::string> pose_names;  ///< of rig_from_board
  std::vector<double> corner_coverage;  ///< for each sensor, share of a grid of the image that has corners
};

/// Residuals of every measurement, outliers too.
std::vector<ResidualSample> residual_samples(const Measurements& measurements,
                                             const JointAdjustment& adjustment);

/// A grid over each sensor's image where its laser planes lie between `near_mm` and `far_mm` of depth (0, 0:
/// where boards showed stripes and a little beyond).
std::vector<UncertaintyCell> uncertainty_map(const Measurements& measurements,
                                             const JointAdjustment& adjustment, const Eigen::Vector3d& up,
                                             double near_mm, double far_mm);

CrossValidation cross_validate(const Measurements& measurements, const JointAdjustment& adjustment,
                               const Eigen::Vector3d& up, const CalibrationOptions& options);

/// The largest principal part of the section's predicted error, and which views would reduce it.
std::string weakest_direction(const Measurements& measurements, const JointAdjustment& adjustment,
                              const Eigen::Vector3d& up);

/// For each sensor the share of 8 x 6 equal parts of its image in which a corner was used.
std::vector<double> corner_coverage(const Measurements& measurements, const JointAdjustment& adjustment);

/// All of it.
CalibrationDiagnosis diagnose(const Measurements& measurements, const JointAdjustment& adjustment,
                              const Eigen::Vector3d& up, const CalibrationOptions& options);

}  // namespace lightstripe
