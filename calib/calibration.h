// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What goes into a calibration besides the observations, and what comes out of it: Options, Summary,
// Diagnosis, Result.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/adjust/lens_model.h"
#include "core/fields.h"
#include "core/rig.h"
#include "core/transform.h"

namespace lightstripe {

struct CalibrationOptions {
  double corner_sigma_px = 0.1;         ///< expected 1-sigma error of a corner, px
  double stripe_sigma_floor_px = 0.05;  ///< added in quadrature to each stripe point's own sigma_px
  double robust_scale = 3.0;            ///< residuals beyond this many sigma lose weight (Huber, then Cauchy)
  double outlier_sigma = 4.5;           ///< residuals beyond this many sigma are left out of the last rounds
  LensModel lens = LensModel::kAuto;  ///< auto: chosen for each sensor by cross-validation, see choose_lens()
  bool board_warp = true;    ///< find the bow of the board as well; it does not average out over the views
  int max_iterations = 100;  ///< of each round
  /// The measuring range, depths in the cameras' frames; 0, 0: where boards showed stripes.
  double range_near_mm = 0, range_far_mm = 0;
};

template <class V>
void visit_fields(V&& v, CalibrationOptions& o) {
  v("corner_sigma_px", o.corner_sigma_px, "expected error of a detected corner, px");
  v("stripe_sigma_floor_px", o.stripe_sigma_floor_px,
    "added in quadrature to each stripe point's predicted error, px");
  v("robust_scale", o.robust_scale, "residuals beyond this many sigma lose weight");
  v("outlier_sigma", o.outlier_sigma, "residuals beyond this many sigma are left out");
  v("lens", o.lens,
    "pinhole | brown4 | brown5 | rational | thin-prism | tilted | tilted5 | tilted-rational (tilted: "
    "Scheimpflug) | auto: by cross-validation");
  v("board_warp", o.board_warp, "find the bow of the board along x and y as well; false: the board is flat");
  v("max_iterations", o.max_iterations, "of each round of the adjustment");
  v("range_near_mm", o.range_near_mm,
    "nearest depth of the measuring range, mm from the camera; 0: not declared");
  v("range_far_mm", o.range_far_mm, "farthest depth of the measuring range; 0: not declared");
}

/// Residuals of one view of one sensor; corners as length of the 2D residual, as OpenCV counts them.
struct ViewResidual {
  std::string sensor, image;
  double board_rms_px = 0;
  double stripe_rms_px = 0;            ///< 0 where the view shows no stripe
  int corners = 0, stripe_points = 0;  ///< used
  int left_out = 0;                    ///< corners and stripe points that did not fit
};

/// A lens model with its error on views that it was not fitted to (rms length of the corners' residuals).
struct LensTrial {
  LensModel lens = LensModel::kAuto;
  double held_out_rms_px = 0;
};

struct LensChoice {
  std::string sensor;
  LensModel lens = LensModel::kAuto;
  std::vector<LensTrial> trials;  ///< empty where the model was given, or the views were too few
};

/// Stripes found on the boards, and those of them that lie in the laser plane at the end.
struct StripeAgreement {
  std::string sensor;
  int plane = 0;
  int found = 0, agreeing = 0;
};

/// Whether and how well it went; starts as "not run".
struct CalibrationSummary {
  bool usable = false;
  std::string message = "not run";  ///< the reason where it is not usable: what is wrong, what to do
  int iterations = 0;
  std::vector<ViewResidual> views;
  std::vector<StripeAgreement> stripes;                     ///< for each laser plane
  std::vector<LensChoice> lenses;                           ///< for each sensor
  Eigen::Vector2d board_warp_mm = Eigen::Vector2d::Zero();  ///< bow at the board's middle, along x and y
};

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

struct CalibrationResult {
  Rig rig;
  CalibrationSummary summary;
  std::optional<CalibrationDiagnosis> diagnosis;  ///< empty where no adjustment was made
};

}  // namespace lightstripe
