// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/register_section.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/counted.h"
#include "core/robust.h"
#include "measure/closest_points.h"
#include "measure/correlation.h"
#include "measure/error_along.h"
#include "measure/robust_line.h"
#include "measure/smoothing_spline.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

ZoneMask mask_of(std::initializer_list<Zone> zones) {
  ZoneMask mask{};
  for (const Zone zone : zones) mask[static_cast<std::size_t>(zone)] = true;
  return mask;
}

ZoneMask unworn_zones(ObjectKind kind) {
  if (kind == ObjectKind::kRail)
    return mask_of({Zone::kFaceRight, Zone::kFaceLeft, Zone::kBelowRight, Zone::kBelowLeft});
  return mask_of({Zone::kFlangeTop, Zone::kBack, Zone::kField});
}

ZoneMask all_zones() {
  ZoneMask mask;
  mask.fill(true);
  return mask;
}

struct Fit {
  SectionPose pose;
  std::vector<FitPoint> points;
};

/// How a stage of the fit runs: which points of the section it looks at, for how long, and how it weighs
/// them.
struct FitStage {
  ZoneMask zones;
  bool upright = false;     ///< no turn
  int step = 1;             ///< every step-th point of the section
  int rounds = 1;           ///< at most
  double first_cap_mm = 1;  ///< bound of the robust scale in the first round; halved from round to round
  double floor_mm = 0.01;   ///< the robust scale never falls below
};

/// Iterates closest points from `pose` until it rests.
Fit iterate(const Section& section, const ReferenceShape& reference, const SectionPose& pose,
            const FitStage& stage) {
  constexpr double kRestsMm = 1e-4, kWidestScaleMm = 0.15;
  Fit fit{pose, {}};
  double cap_mm = stage.first_cap_mm;
  const auto look = [&] {
    fit.points = find_counterparts(section, fit.pose, reference, stage.step);
    weigh(fit.points, stage.zones, stage.floor_mm, cap_mm);
  };
  for (int round = 0; round < stage.rounds; ++round) {
    look();
    cap_mm = std::max(cap_mm / 2, kWidestScaleMm);
    if (apply_step(normal_equations(fit.points), stage.upright, fit.pose) < kRestsMm) break;
  }
  look();
  return fit;
}

/// On every third point until the pose rests, then on all.
Fit settle(const Section& section, const ReferenceShape& reference, const ZoneMask& zones, bool upright,
           const RegistrationOptions& options, const SectionPose& pose) {
  FitStage stage{zones, upright, 3, 6, 0.2, options.noise_floor_mm};
  const Fit rough = iterate(section, reference, pose, stage);
  stage.step = 1, stage.rounds = 3;
  return iterate(section, reference, rough.pose, stage);
}

/// How badly the section lies: mean of min(distance, 1 mm)^2, points out of reach count in full.
double badness(const Fit& fit, std::size_t looked_at) {
  double sum = static_cast<double>(looked_at) - static_cast<double>(fit.points.size());
  for (const FitPoint& point : fit.points) sum += std::min(1.0, point.residual * point.residual);
  return sum;
}

/// The best of the coarse poses after a quick fit on some 200 points. All zones guide it: where the head is
/// worn, the rest outweighs it.
Fit start(const Section& section, const ReferenceShape& reference, const SectionPrior& prior,
          const RegistrationOptions& options) {
  constexpr std::size_t kPoints = 200;
  const int step = static_cast<int>(std::max<std::size_t>(1, section.size() / kPoints));
  const CoarsePoseOptions coarse{prior.upright ? 0.0 : options.max_tilt_deg, prior.may_mirror,
                                 prior.may_be_upside_down, 3};
  Fit best;
  double best_badness = 1e300;
  const FitStage quick{all_zones(), prior.upright, 2 * step, 6, 2.0, 0.1};
  for (const SectionPose& pose : coarse_poses(section, reference, coarse)) {
    Fit fit = iterate(section, reference, pose, quick);
    const double bad = badness(fit, section.size() / static_cast<std::size_t>(2 * step));
    if (bad < best_badness) best_badness = bad, best = std::move(fit);
  }
  best = iterate(section, reference, best.pose, {all_zones(), prior.upright, step, 3, 0.5, 0.1});
  return iterate(section, reference, best.pose,
                 {unworn_zones(reference.kind()), prior.upright, step, 5, 0.5, 0.02});
}

int count_near(const std::vector<FitPoint>& points, Zone zone) {
  constexpr double kNearMm = 1;
  return static_cast<int>(std::count_if(points.begin(), points.end(), [&](const FitPoint& p) {
    return p.zone == zone && std::abs(p.residual) < kNearMm;
  }));
}

RegistrationView view_of(const std::vector<FitPoint>& points, int step) {
  constexpr int kEnough = 24;
  const bool right = count_near(points, Zone::kBelowRight) * step >= kEnough;
  const bool left = count_near(points, Zone::kBelowLeft) * step >= kEnough;
  if (right && left) return RegistrationView::kBothSides;
  return right || left ? RegistrationView::kOneSide : RegistrationView::kHeadOnly;
}

/// Whether a head face lies off the reference although the rest fits: mean residual against what its noise
/// and the fit allow.
bool has_moved(const std::vector<FitPoint>& points, Zone face, const Matrix3d& covariance, double rms_mm,
               double correlated, double moved_mm) {
  constexpr int kEnough = 6;
  double sum = 0, count = 0;
  Vector3d J = Vector3d::Zero();
  for (const FitPoint& point : points) {
    if (point.zone != face) continue;
    const Vector2d &p = point.position, &n = point.normal;
    sum += point.residual, count += 1;
    J += Vector3d(p.x() * n.y() - p.y() * n.x(), n.x(), n.y());
  }
  if (count < kEnough) return true;  // too few to tell: they need not count
  J /= count;
  const double variance = J.dot(covariance * J) + rms_mm * rms_mm * std::min(1.0, correlated / count);
  return std::abs(sum / count) > std::max(moved_mm, 3 * std::sqrt(variance));
}

double median_predicted(const Section& section, const std::vector<FitPoint>& points) {
  std::vector<double> sigmas;
  for (const FitPoint& point : points)
    if (point.weight > 0) sigmas.push_back(section[static_cast<std::size_t>(point.index)].sigma_mm);
  return sigmas.empty() ? 0 : upper_median(sigmas);
}

/// Of neighbouring points about whatever shape they lie on.
double scatter_mm(const std::vector<FitPoint>& points) {
  constexpr std::size_t kFewest = 10;
  std::vector<double> residuals;
  for (const FitPoint& point : points) residuals.push_back(point.residual);
  return residuals.size() < kFewest ? 0 : difference_noise(residuals);
}

void describe(const Section& section, const Fit& fit, bool upright, Registration& out) {
  const NormalEquations equations = normal_equations(fit.points);
  out.reference_from_section = fit.pose;
  out.num_points = static_cast<int>(
      std::count_if(fit.points.begin(), fit.points.end(), [](const FitPoint& p) { return p.weight > 0; }));
  out.rms_mm = equations.weight > 0 ? std::sqrt(equations.squares / equations.weight) : 0.0;
  out.correlated_points = correlated_points(section, fit.points);
  out.correlation_mm = correlation_length_mm(section, fit.points);
  out.error = error_along(section, fit.points);
  out.predicted_mm = median_predicted(section, fit.points);
  out.stretch_error_mm = stretch_error_mm(section, fit.points);
  const double variance = kTukeyVariance * out.rms_mm * out.rms_mm * out.correlated_points;
  out.covariance.setZero();
  if (upright) {
    if (equations.H.bottomRightCorner<2, 2>().determinant() > 0)
      out.covariance.bottomRightCorner<2, 2>() = variance * equations.H.bottomRightCorner<2, 2>().inverse();
  } else if (equations.H.determinant() > 0) {
    out.covariance = variance * equations.H.inverse();
  }
}

/// The same of a wheel, whose few unworn stretches may be off as a whole.
void describe_wheel(const Section& section, const Fit& fit, bool upright, Registration& out) {
  describe(section, fit, upright, out);
  if (out.covariance.isZero()) return;
  const Matrix3d noise = gradient_covariance(out.error, section, fit.points);
  const Matrix3d H = normal_equations(fit.points).H;
  if (upright) {
    const Eigen::Matrix2d inverse = H.bottomRightCorner<2, 2>().inverse();
    out.covariance.bottomRightCorner<2, 2>() = inverse * noise.bottomRightCorner<2, 2>() * inverse;
  } else {
    const Matrix3d inverse = H.inverse();
    out.covariance = inverse * noise * inverse;
  }
}

/// Fits to what does not wear; then again without the head faces, which come back only where they agree.
void refine_rail(const Section& section, const ReferenceShape& reference, bool upright,
                 const RegistrationOptions& options, Fit& fit, Registration& out) {
  ZoneMask mask = mask_of({Zone::kBelowRight, Zone::kBelowLeft});
  fit = settle(section, reference, mask, upright, options, fit.pose);
  describe(section, fit, upright, out);
  bool grown = false;
  for (const Zone face : {Zone::kFaceRight, Zone::kFaceLeft}) {
    if (has_moved(fit.points, face, out.covariance, out.rms_mm, out.correlated_points, options.moved_face_mm))
      continue;
    mask[static_cast<std::size_t>(face)] = grown = true;
  }
  if (!grown) return;
  fit = settle(section, reference, mask, upright, options, fit.pose);
  describe(section, fit, upright, out);
}

/// Share of the points on parts that do not wear (faces apart) that count.
double fitting_share(const Fit& fit, ObjectKind kind) {
  double all = 0, counting = 0;
  for (const FitPoint& point : fit.points) {
    const bool asked = kind == ObjectKind::kRail
                           ? point.zone == Zone::kBelowRight || point.zone == Zone::kBelowLeft
                           : point.zone == Zone::kFlangeTop || point.zone == Zone::kBack;
    if (!asked) continue;
    all += 1;
    counting += point.weight > 0 ? 1 : 0;
  }
  return all > 0 ? counting / all : 0.0;
}

std::string judged(const Fit& fit, const Registration& out, const ReferenceShape& reference,
                   const RegistrationOptions& options) {
  if (out.num_points < options.min_fit_points)
    return fmt::format("only {} on parts that do not wear, {} needed", counted(out.num_points, "point"),
                       options.min_fit_points);
  if (out.rms_mm > options.max_fit_rms_mm)
    return fmt::format("fit to {} is {:.2f} mm rms, limit {:.2f}", reference.name(), out.rms_mm,
                       options.max_fit_rms_mm);
  const double share = fitting_share(fit, reference.kind());
  if (out.view != RegistrationView::kHeadOnly && share < options.min_fit_share)
    return fmt::format("only {:.0f} % of the unworn parts fit {}", 100 * share, reference.name());
  const Vector2d top(reference.top_u(), reference.top_v());
  const double sigma = std::max(out.sigma_of(top, {1, 0}), out.sigma_of(top, {0, 1}));
  if (!(sigma <= options.max_place_sigma_mm) || out.covariance.isZero())
    return fmt::format("place known to {:.2f} mm only, limit {:.2f}", sigma, options.max_place_sigma_mm);
  return "";
}

/// Whether a head alone surely lies on the reference's: nearly all of it, closely.
bool head_fits(const Registration& found, std::size_t points) {
  constexpr double kCloseMm = 0.1, kShare = 0.7;
  return found.rms_mm <= kCloseMm && found.num_points >= kShare * static_cast<double>(points);
}

}  // namespace

double Registration::sigma_of(const Vector2d& p, const Vector2d& direction) const {
  const Vector3d J(p.x() * direction.y() - p.y() * direction.x(), direction.x(), direction.y());
  return std::sqrt(std::max(0.0, J.dot(covariance * J)));
}

Registration register_section(const Section& section, const ReferenceShape& reference,
                              const SectionPrior& prior, const RegistrationOptions& options) {
  Registration out;
  if (static_cast<int>(section.size()) < options.min_fit_points) {
    out.reason = "only " + counted(section.size(), "point");
    return out;
  }
  Fit fit;
  if (prior.pose) {
    fit.pose = *prior.pose;
    fit.points = find_counterparts(section, fit.pose, reference);
    weigh(fit.points, unworn_zones(reference.kind()), options.noise_floor_mm, 1.0);
    describe(section, fit, true, out);
    out.covariance.setZero();                             // known beforehand
    out.stretch_error_mm = 0, out.correlated_points = 1;  // what is off is the object, not the measurement
    out.error = {scatter_mm(fit.points), 0, 1};
    out.view = RegistrationView::kBothSides;
    out.reason.clear();
    return out;
  }
  fit = start(section, reference, prior, options);
  const bool rail = reference.kind() == ObjectKind::kRail;
  const int step = static_cast<int>(std::max<std::size_t>(1, section.size() / 200));
  out.view = rail ? view_of(fit.points, step) : RegistrationView::kBothSides;
  if (rail && out.view != RegistrationView::kHeadOnly) {
    refine_rail(section, reference, prior.upright, options, fit, out);
  } else {
    fit = settle(section, reference, rail ? all_zones() : unworn_zones(reference.kind()), prior.upright,
                 options, fit.pose);
    (rail ? describe : describe_wheel)(section, fit, prior.upright, out);
  }
  out.reason = judged(fit, out, reference, options);
  if (out.view == RegistrationView::kHeadOnly && !options.on_head) {
    out.head_fits = head_fits(out, section.size());
    out.reason = "head only: without web or foot the unworn rail's place is not known";
  }
  return out;
}

}  // namespace lightstripe
