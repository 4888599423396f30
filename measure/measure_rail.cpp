// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_rail.h"

#include <algorithm>
#include <cmath>

#include "core/transform.h"
#include "measure/rail_head.h"
#include "measure/robust_line.h"
#include "measure/surface_fit.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

Estimate wear_of(const SurfaceFit& fit, const Registration& registration, const std::string& what) {
  if (!fit.known()) return Estimate::unknown(what + " " + fit.reason);
  return Estimate::known(fit.wear_mm, sigma_of(fit, registration));
}

/// The corner's place on the reference: where its normal looks 45 deg up and out.
Estimate corner_wear(const PlacedSection& placed, int side) {
  const Vector2d outwards = Vector2d(side, 1).normalized();
  double best = -1e300;
  Vector2d corner = Vector2d::Zero();
  for (const OutlineSample& point : sample(placed.reference.outline(), 0.25)) {
    if (point.position.y() < placed.reference.head_bottom_v()) continue;
    const double reach = point.position.dot(outwards);
    if (reach > best) best = reach, corner = point.position;
  }
  return wear_of(fit_surface(placed, {corner, outwards, -2, 2, 16, 2}), placed.registration, "gauge corner");
}

SurfaceFit fit_face(const PlacedSection& placed, int side, double v) {
  return fit_head_face(placed, {0, v}, {side, 0});
}

Estimate width_of(const PlacedSection& placed, double depth_v) {
  const SurfaceFit right = fit_face(placed, 1, depth_v), left = fit_face(placed, -1, depth_v);
  if (!right.known()) return Estimate::unknown("head face +y " + right.reason);
  if (!left.known()) return Estimate::unknown("head face -y " + left.reason);
  // Along two opposite directions: a shift cancels, so do the responses' sum.
  return Estimate::known(right.along_mm + left.along_mm, sigma_of_sum(right, left, placed.registration));
}

Estimate face_angle(const PlacedSection& placed, int side, double gauge_v) {
  constexpr double kFewestMm = 6, kLongestMm = 20;
  const double lowest = std::max(placed.reference.head_bottom_v() + 1, gauge_v - kLongestMm);
  if (gauge_v - lowest < kFewestMm) return Estimate::unknown("too little of the gauge face is left");
  const double middle = (gauge_v + lowest) / 2;
  std::vector<Sample1> face;
  std::vector<PlaceOnStripe> places;
  double first = 1e300, last = -1e300;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d& p = placed.points[i];
    if (p.x() * side < 20 || p.y() > gauge_v - 0.5 || p.y() < lowest) continue;
    face.push_back({p.y() - middle, p.x() * side, placed.section[i].weight});
    places.push_back({p.y(), placed.section[i].chain});
    first = std::min(first, p.y()), last = std::max(last, p.y());
  }
  const auto fit = fit_polynomial(face, 1, 0.005);
  if (!fit || last - first < kFewestMm) return Estimate::unknown("gauge face not seen");
  const double local =
      sigma_of_sum(where_points_scatter(placed.registration.error, fit->rms, fit->num_samples), places,
                   influences(face, *fit, 1, 0, 1));
  const double turn = std::sqrt(placed.registration.covariance(0, 0));
  return Estimate::known(-std::atan(fit->slope) / kDegree, std::hypot(local, turn) / kDegree);
}

/// A parabola over 10 mm either side: its vertex radius differs from the circle's by (10 / R)^2, 0.1 % at R
/// 300.
Estimate crown_radius(const PlacedSection& placed, const HeadTop& top) {
  constexpr double kHalfWidthMm = 10, kFlattestMm = 5000;
  if (!top.reason.empty()) return Estimate::unknown(top.reason);
  std::vector<Sample1> crown;
  std::vector<PlaceOnStripe> places;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d& p = placed.points[i];
    if (std::abs(p.x()) >= kHalfWidthMm || std::abs(p.y() - top.v) >= 2) continue;
    crown.push_back({p.x(), p.y(), placed.section[i].weight});
    places.push_back({p.x(), placed.section[i].chain});
  }
  const auto fit = fit_polynomial(crown, 2, 0.005);
  if (!fit || crown.size() < 12) return Estimate::unknown("crown not seen");
  if (fit->curvature > -1 / kFlattestMm) return Estimate::unknown("crown is flat or hollow");
  const double radius = -std::pow(1 + fit->slope * fit->slope, 1.5) / fit->curvature;
  const double curvature_sigma =
      sigma_of_sum(where_points_scatter(placed.registration.error, fit->rms, fit->num_samples), places,
                   influences(crown, *fit, 2, 0, 2));
  return Estimate::known(radius, radius * radius * curvature_sigma);
}

RailMeasurement unknown_rail(const std::string& reason) {
  RailMeasurement out;
  for (Estimate* estimate :
       {&out.vertical_wear, &out.side_wear, &out.corner45_wear, &out.head_width, &out.head_area_loss,
        &out.gauge_face_angle, &out.inclination, &out.crown_radius, &out.lip})
    *estimate = Estimate::unknown(reason);
  return out;
}

/// A head alone says nothing of wear, but how wide and how round it is.
RailMeasurement head_alone(const PlacedSection& placed, const RailOptions& options) {
  RailMeasurement out = unknown_rail(placed.registration.reason);
  const HeadTop top = find_head_top(placed);
  out.crown_radius = crown_radius(placed, top);
  if (options.gauge_height == GaugeHeight::kMeasuredTop)
    out.head_width =
        top.reason.empty() ? width_of(placed, top.v - options.gauge_point_mm) : Estimate::unknown(top.reason);
  return out;
}

}  // namespace

RailMeasurement measure_rail(const Section& section, const ReferenceShape& reference,
                             const Registration& registration, const RailOptions& options) {
  if (!registration.usable() && !registration.head_fits) return unknown_rail(registration.reason);
  const PlacedSection placed = place(section, reference, registration);
  if (!registration.usable()) return head_alone(placed, options);
  const int side = options.gauge_side == GaugeSide::kLeft ? 1 : -1;
  RailMeasurement out;
  out.vertical_wear = wear_of(fit_surface(placed, {{0, reference.top_v()}, {0, 1}, -4, 4, 20, 2}),
                              registration, "top of the head");
  out.corner45_wear = corner_wear(placed, side);
  out.head_area_loss = head_area_loss(placed);
  out.inclination = Estimate::known(-registration.reference_from_section.move.angle_rad / kDegree,
                                    std::sqrt(registration.covariance(0, 0)) / kDegree);
  out.lip = find_lip(placed, side, options.lip_mm);
  const HeadTop top = find_head_top(placed);
  out.crown_radius = crown_radius(placed, top);
  const bool floating = options.gauge_height == GaugeHeight::kMeasuredTop;
  if (floating && !top.reason.empty()) {
    out.side_wear = out.head_width = out.gauge_face_angle = Estimate::unknown(top.reason);
    return out;
  }
  const double gauge_v = (floating ? top.v : reference.top_v()) - options.gauge_point_mm;
  const SurfaceFit face = fit_face(placed, side, gauge_v);
  const bool shadowed = !face.known() && out.lip.value.value_or(0) > 0;
  out.side_wear = wear_of(face, registration, shadowed ? "a lip shadows the gauge point:" : "gauge face");
  out.head_width = width_of(placed, gauge_v);
  out.gauge_face_angle = face_angle(placed, side, gauge_v);
  return out;
}

}  // namespace lightstripe
