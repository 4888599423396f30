// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Observations -> rig: one joint bundle adjustment over intrinsics, distortion, board poses, laser planes,
// sensor-to-sensor transforms and motion.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "calib/lens_model.h"
#include "calib/observations.h"
#include "core/fields.h"
#include "core/rig.h"

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

/// Whether and how well it went; starts as "not run".
struct CalibrationSummary {
  bool usable = false;
  std::string message = "not run";  ///< the reason where it is not usable: what is wrong, what to do
  int iterations = 0;
  std::vector<ViewResidual> views;
  std::vector<LensChoice> lenses;                           ///< for each sensor
  Eigen::Vector2d board_warp_mm = Eigen::Vector2d::Zero();  ///< bow at the board's middle, along x and y
};

struct CalibrationDiagnosis;

struct CalibrationResult {
  Rig rig;
  CalibrationSummary summary;
  std::shared_ptr<const CalibrationDiagnosis>
      diagnosis;  ///< see diagnosis.h; none where no adjustment was made
};

CalibrationResult calibrate_rig(const CalibrationObservations& observations,
                                const CalibrationOptions& options = {});

}  // namespace lightstripe
