// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A measured section laid on its reference by what wear has spared, with the covariance of that move.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/fields.h"
#include "measure/coarse_pose.h"
#include "measure/error_along.h"

namespace lightstripe {

/// Which part of a rail the registration rests on.
enum class RegistrationView {
  kNone,
  kBothSides,  ///< web, fishing surfaces or foot on both sides
  kOneSide,    ///< of one side only: poorer, see the covariance
  kHeadOnly    ///< head alone: where it stood before it wore is not known
};

struct RegistrationOptions {
  double max_fit_rms_mm = 0.3;  ///< above: the section does not fit the reference
  int min_fit_points = 60;
  double min_fit_share = 0.5;       ///< of the points on parts that do not wear
  double max_place_sigma_mm = 0.2;  ///< predicted, at the top of the rail or the wheel's datum
  double max_tilt_deg = 9;
  bool on_head = false;  ///< also where only a rail's head is seen: laid on by its whole shape, which is
                         ///< no absolute wear
  double moved_face_mm = 0.01;    ///< a head face farther off than this, and than 3 sigma, has worn: left out
  double noise_floor_mm = 0.005;  ///< robust scale below which weights do not narrow further
};
template <class V>
void visit_fields(V&& v, RegistrationOptions& o) {
  v("max_fit_rms_mm", o.max_fit_rms_mm, "above: the section does not fit the reference");
  v("min_fit_points", o.min_fit_points, "fewer points on parts that do not wear: not registered");
  v("min_fit_share", o.min_fit_share, "share of the points there that must fit");
  v("max_place_sigma_mm", o.max_place_sigma_mm, "predicted, at the top of the rail");
  v("on_head", o.on_head,
    "registers a head seen without web and foot by its shape; its wear is not absolute");
  v("max_tilt_deg", o.max_tilt_deg, "how far a section may be turned against the reference");
  v("moved_face_mm", o.moved_face_mm, "a head face farther off than this and 3 sigma is left out as worn");
  v("noise_floor_mm", o.noise_floor_mm, "robust scale below which weights do not narrow further");
}

/// What is known of the section beforehand.
struct SectionPrior {
  bool may_mirror = false;
  bool may_be_upside_down = false;
  bool upright = false;  ///< its angle is right (a rotary scan, an aligned file): only shifts are sought
  std::optional<SectionPose> pose = {};  ///< known altogether; nothing is sought but how well it fits
};

struct Registration {
  SectionPose reference_from_section;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< of (turn about the reference's origin, rad; shift u, v, mm)
  double rms_mm = 0;            ///< distances of the points that count
  int num_points = 0;           ///< that count
  double correlated_points =
      1;  ///< neighbouring points that share one error; the mean of n points has sigma = rms * sqrt(this / n)
  double correlation_mm = 0;    ///< along the stripes, over which the scatter's correlation falls to 1/e
  double stretch_error_mm = 0;  ///< what the place of a short stretch of surface errs by, beyond scatter
  ErrorAlong error;             ///< of its points
  double predicted_mm = 0;      ///< median of the counting points' own predicted errors; 0: not known
  RegistrationView view = RegistrationView::kNone;
  std::string reason = "not registered";  ///< empty: usable
  /// Not usable since only the head is seen, which lies on the reference's by its shape: what does not ask
  /// where it once stood is known.
  bool head_fits = false;

  bool usable() const { return reason.empty(); }
  /// Of the displacement along `direction` (unit) of a point given on the reference, mm.
  double sigma_of(const Eigen::Vector2d& p, const Eigen::Vector2d& direction) const;
};

/// Starts from foot, fillets, web and both head faces (rail) or back, flange top and field side (wheel),
/// weights by distance (iterative closest point, point to line, Tukey's weights), leaves out a head face that
/// has moved against the rest, and gates on rms, number and share of points and predicted place. The
/// covariance rests on the residuals and on how far they are correlated along the stripes.
Registration register_section(const Section& section, const ReferenceShape& reference,
                              const SectionPrior& prior = {}, const RegistrationOptions& options = {});

}  // namespace lightstripe
