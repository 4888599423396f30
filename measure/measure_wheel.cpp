// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_wheel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/robust_line.h"
#include "measure/surface_fit.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kMinScaleMm = 0.005;

/// A coordinate of the section with its 1-sigma error, or why it is not known.
struct Place {
  std::string reason;  ///< empty: known
  double value = 0, sigma = 0;
  bool known() const { return reason.empty(); }
};

Place place_from(const std::optional<PolynomialFit>& fit, double at, const Registration& registration,
                 const std::string& what) {
  if (!fit) return {what + " not seen", 0, 0};
  const double scatter = std::max(fit->rms, kMinScaleMm) * std::sqrt(fit->value_factor);
  return {"", at + fit->value, std::hypot(scatter, registration.stretch_error_mm)};
}

/// u of the wheel's back: of its own points, else of the registration.
Place find_back(const PlacedSection& placed, const WheelSectionKind& kind) {
  constexpr double kBackU = -70, kNearMm = 3, kFewest = 8;
  if (kind.back_is_given) return {"", kBackU, 0};
  std::vector<Sample1> back;
  for (const Vector2d& p : placed.points)
    if (std::abs(p.x() - kBackU) < kNearMm && p.y() < placed.reference.top_v() - 19.5 && p.y() > -40)
      back.push_back({p.y(), p.x() - kBackU});
  if (static_cast<double>(back.size()) >= kFewest) {
    const Place seen = place_from(fit_polynomial(back, 0, kMinScaleMm), kBackU, placed.registration, "back");
    if (seen.known()) return seen;
  }
  return {"", kBackU, placed.registration.sigma_of({kBackU, 0}, {1, 0})};
}

Place tread_height(const PlacedSection& placed, double u) {
  constexpr double kHalfWidthMm = 4, kDeepMm = 20;
  std::vector<Sample1> samples;
  bool left = false, right = false;
  for (const Vector2d& p : placed.points)
    if (std::abs(p.x() - u) < kHalfWidthMm && std::abs(p.y()) < kDeepMm) {
      samples.push_back({p.x() - u, p.y()});
      (p.x() < u ? left : right) = true;
    }
  if (!left || !right) return {"tread at the datum not seen", 0, 0};
  return place_from(fit_polynomial(samples, 2, kMinScaleMm), 0, placed.registration, "tread at the datum");
}

struct Tip {
  Place height;
  double u = 0;
};

/// A parabola over the highest 5 mm of the flange (R 12: its fourth order is below 0.001 mm there).
Tip find_tip(const PlacedSection& placed) {
  constexpr double kFlangeU = -42, kHalfWidthMm = 2.5, kAboveDatumMm = 15;
  const Vector2d* highest = nullptr;
  for (const Vector2d& p : placed.points)
    if (p.x() < kFlangeU && p.x() > -75 && p.y() < placed.reference.top_v() + 15 && p.y() > kAboveDatumMm &&
        (!highest || p.y() > highest->y()))
      highest = &p;
  if (!highest) return {{"flange tip not seen", 0, 0}, 0};
  std::vector<Sample1> samples;
  for (const Vector2d& p : placed.points)
    if (std::abs(p.x() - highest->x()) < kHalfWidthMm && highest->y() - p.y() < 2)
      samples.push_back({p.x() - highest->x(), p.y() - highest->y()});
  const auto fit = fit_polynomial(samples, 2, kMinScaleMm);
  if (!fit || fit->curvature >= 0) return {{"flange tip not seen", 0, 0}, 0};
  const double vertex = -fit->slope / fit->curvature;
  // The top lies between points on its either side, else the section ends before it.
  constexpr double kBesideMm = 0.8;
  const auto left = [&](const Sample1& s) { return s.t < vertex - kBesideMm; };
  const auto right = [&](const Sample1& s) { return s.t > vertex + kBesideMm; };
  if (std::count_if(samples.begin(), samples.end(), left) < 2 ||
      std::count_if(samples.begin(), samples.end(), right) < 2)
    return {{"flange tip not seen", 0, 0}, 0};
  Tip tip{place_from(fit, highest->y(), placed.registration, "flange tip"), highest->x() + vertex};
  tip.height.value += fit->slope * vertex + fit->curvature * vertex * vertex / 2;
  return tip;
}

/// u of the flange's face towards the tread at a height.
Place face_at(const PlacedSection& placed, double v, double half_height_mm, double tip_u,
              const std::string& what) {
  constexpr double kWidestMm = 30;
  std::vector<Sample1> samples;
  bool above = false, below = false;
  for (const Vector2d& p : placed.points)
    if (p.x() > tip_u && p.x() < tip_u + kWidestMm && std::abs(p.y() - v) < half_height_mm) {
      samples.push_back({p.y() - v, p.x() - tip_u});
      (p.y() < v ? below : above) = true;
    }
  if (!above || !below) return {what + " not seen", 0, 0};
  const int degree = samples.size() >= 6 ? 2 : 1;
  return place_from(fit_polynomial(samples, degree, kMinScaleMm), tip_u, placed.registration, what);
}

Estimate difference(const Place& a, const Place& b) {
  if (!a.known()) return Estimate::unknown(a.reason);
  if (!b.known()) return Estimate::unknown(b.reason);
  return Estimate::known(a.value - b.value, std::hypot(a.sigma, b.sigma));
}

/// How far the tread lies below its highest point on the field side, by medians of strips.
Estimate hollow_of(const PlacedSection& placed) {
  constexpr double kFirstU = -20, kFieldU = 15, kLastU = 50, kSeenU = 36, kStripMm = 2;
  std::vector<Sample1> strips;
  for (double u = kFirstU; u <= kLastU; u += kStripMm) {
    std::vector<double> heights;
    for (const Vector2d& p : placed.points)
      if (std::abs(p.x() - u) < kStripMm / 2 && std::abs(p.y()) < 20) heights.push_back(p.y());
    if (!heights.empty()) strips.push_back({u, median_of(heights)});
  }
  if (strips.size() < 20 || strips.back().t < kSeenU)
    return Estimate::unknown("tread not seen to the field side");
  const Sample1* high = nullptr;
  for (const Sample1& s : strips)
    if (s.t >= kFieldU && (!high || s.value > high->value)) high = &s;
  double depth = 0;
  for (const Sample1& s : strips)
    if (s.t < high->t) depth = std::max(depth, high->value - s.value);
  const double noise = std::max(placed.registration.rms_mm, kMinScaleMm);
  return Estimate::known(depth, noise * std::sqrt(2.0));
}

Estimate rim_width(const PlacedSection& placed, const Place& back) {
  constexpr double kNarrowestU = 55, kWidestU = 80, kBelowChamferMm = 9, kFewest = 8;
  std::vector<double> outer;
  for (const Vector2d& p : placed.points)
    if (p.x() > kNarrowestU && p.x() < kWidestU && p.y() < -kBelowChamferMm && p.y() > -50)
      outer.push_back(p.x());
  if (static_cast<double>(outer.size()) < kFewest) return Estimate::unknown("outer face not seen");
  const double face = median_of(outer);
  std::vector<double> scatter;
  for (const double u : outer) scatter.push_back(std::abs(u - face));
  const double sigma =
      std::max(kMinScaleMm, 1.4826 * median_of(scatter)) *
      std::sqrt(std::min(1.0, placed.registration.correlated_points / static_cast<double>(outer.size())));
  return difference({"", face, sigma}, back);
}

Estimate diameter_of(const Place& tread, const Registration& registration, const WheelSectionKind& kind) {
  if (!kind.radial && !kind.radius_offset_mm) return Estimate::unknown("v is no radius: not a rotary scan");
  if (!tread.known()) return Estimate::unknown(tread.reason);
  const double radius = kind.radial ? tread.value - registration.reference_from_section.move.translation.y()
                                    : tread.value + *kind.radius_offset_mm;
  Estimate out = Estimate::known(2 * radius, 0);
  out.sigma.reset();
  if (kind.axis_sigma_mm) out.sigma = 2 * std::hypot(tread.sigma, *kind.axis_sigma_mm);
  return out;
}

}  // namespace

WheelMeasurement measure_wheel(const Section& section, const ReferenceShape& reference,
                               const Registration& registration, const WheelSectionKind& kind,
                               const WheelOptions& options) {
  WheelMeasurement out;
  if (!registration.usable()) {
    visit_estimates(
        [&](const char*, Estimate& estimate) { estimate = Estimate::unknown(registration.reason); }, out);
    return out;
  }
  const PlacedSection placed = place(section, reference, registration);
  const Place back = find_back(placed, kind);
  const double datum_u = back.value + options.datum_mm;
  const Place tread = tread_height(placed, datum_u);
  const Tip tip = find_tip(placed);
  out.flange_height = difference(tip.height, tread);
  out.hollow = hollow_of(placed);
  out.rim_width = rim_width(placed, back);
  out.diameter = diameter_of(tread, registration, kind);
  const auto nominal = reference.surface_along({datum_u, 0}, {0, 1}, 0);
  out.tread_wear = out.flange_height;
  if (out.tread_wear.value && nominal) *out.tread_wear.value -= reference.top_v() - *nominal;
  if (!tread.known() || !tip.height.known()) {
    out.flange_thickness = out.qr = Estimate::unknown(tread.known() ? tip.height.reason : tread.reason);
    return out;
  }
  const Place face = face_at(placed, tread.value + options.face_height_mm, 1.0, tip.u, "flange face");
  const Place upper =
      face_at(placed, tip.height.value - options.qr_below_tip_mm, 0.8, tip.u, "flange below its tip");
  out.flange_thickness = difference(face, back);
  out.qr = difference(face, upper);
  return out;
}

}  // namespace lightstripe
