// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/robust.h"
#include "measure/robust_line.h"
#include "measure/surface_fit.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// What the section says of `point`, which must be an element of placed.points.
const SectionPoint& unplaced(const PlacedSection& placed, const Vector2d& point) {
  return placed.section[static_cast<std::size_t>(&point - placed.points.data())];
}

/// Points that a fit takes, by their place along it, and their predicted errors.
struct SeenPoints {
  std::vector<Sample1> samples;
  std::vector<double> sigmas_mm;

  void add(const PlacedSection& placed, const Vector2d& point, double t, double value) {
    const SectionPoint& seen = unplaced(placed, point);
    samples.push_back({t, value, seen.weight});
    sigmas_mm.push_back(seen.sigma_mm);
  }
};

/// A coordinate of the section with its 1-sigma error, or why it is not known.
struct Place {
  std::string reason;  ///< empty: known
  double value = 0, sigma = 0;
  double per_turn = 0;  ///< how far it moves where the section is turned, mm per rad
  bool known() const { return reason.empty(); }
};

Place unseen(const std::string& what) { return {what + " not seen"}; }

/// 1-sigma of a fit's value at `t`: of what its points err by, each by itself and together with its
/// neighbours, as they predict it here, and, where they scatter clearly more than that, by that.
double sigma_at(const PolynomialFit& fit, const SeenPoints& seen, int degree, double t,
                const Registration& registration) {
  const double slope = fit.slope + fit.curvature * t, steep = std::hypot(1, slope);
  std::vector<double> places;
  for (const Sample1& s : seen.samples) places.push_back(steep * s.t);
  const double here = std::max(fit.rms / steep, kMinScaleMm);
  const ErrorAlong error = as_predicted_here(registration, usual_prediction(seen.sigmas_mm));
  return steep * sigma_of_sum(where_points_scatter(error, here, fit.num_samples), places,
                              influences(seen.samples, fit, degree, t));
}

/// The samples' polynomial at `t`, over `from`.
Place place_from(const SeenPoints& seen, int degree, double from, double per_turn,
                 const PlacedSection& placed, const std::string& what) {
  const auto fit = fit_polynomial(seen.samples, degree, kMinScaleMm);
  if (!fit) return unseen(what);
  return {"", from + fit->value, sigma_at(*fit, seen, degree, 0, placed.registration), per_turn};
}

double mean_of_places(const std::vector<Sample1>& samples) {
  double sum = 0;
  for (const Sample1& s : samples) sum += s.t;
  return sum / static_cast<double>(samples.size());
}

/// u of the wheel's back: of its own points, else of the registration.
Place find_back(const PlacedSection& placed, const WheelSectionKind& kind) {
  constexpr double kBackU = -70, kNearMm = 3, kFewest = 8;
  if (kind.back_is_given) return {"", kBackU};
  SeenPoints back;
  for (const Vector2d& p : placed.points)
    if (std::abs(p.x() - kBackU) < kNearMm && p.y() < placed.reference.top_v() - 19.5 && p.y() > -40)
      back.add(placed, p, p.y(), p.x() - kBackU);
  if (static_cast<double>(back.samples.size()) >= kFewest) {
    Place seen = place_from(back, 0, kBackU, -mean_of_places(back.samples), placed, "back");
    if (seen.known()) return seen;
  }
  return {"", kBackU, placed.registration.sigma_of({kBackU, 0}, {1, 0})};
}

Place tread_height(const PlacedSection& placed, double u) {
  constexpr double kHalfWidthMm = 4, kDeepMm = 20;
  SeenPoints seen;
  bool left = false, right = false;
  for (const Vector2d& p : placed.points)
    if (std::abs(p.x() - u) < kHalfWidthMm && std::abs(p.y()) < kDeepMm) {
      seen.add(placed, p, p.x() - u, p.y());
      (p.x() < u ? left : right) = true;
    }
  if (!left || !right) return unseen("tread at the datum");
  return place_from(seen, 2, 0, u, placed, "tread at the datum");
}

struct Tip {
  Place height;
  double u = 0;
};

/// A parabola over the highest 3 mm of the flange: narrow, since a worn tip may have an edge.
Tip find_tip_itself(const PlacedSection& placed) {
  constexpr double kFlangeU = -42, kHalfWidthMm = 1.6, kAboveDatumMm = 15;
  const Vector2d* highest = nullptr;
  for (const Vector2d& p : placed.points)
    if (p.x() < kFlangeU && p.x() > -75 && p.y() < placed.reference.top_v() + 15 && p.y() > kAboveDatumMm &&
        (!highest || p.y() > highest->y()))
      highest = &p;
  if (!highest) return {unseen("flange tip"), 0};
  SeenPoints seen;
  for (const Vector2d& p : placed.points)
    if (std::abs(p.x() - highest->x()) < kHalfWidthMm && highest->y() - p.y() < 2)
      seen.add(placed, p, p.x() - highest->x(), p.y() - highest->y());
  const auto fit = fit_polynomial(seen.samples, 2, kMinScaleMm);
  if (!fit || fit->curvature >= 0) return {unseen("flange tip"), 0};
  const double vertex = -fit->slope / fit->curvature;
  // The top lies between points on its either side, else the section ends before it.
  constexpr double kBesideMm = 0.5;
  const auto left = [&](const Sample1& s) { return s.t < vertex - kBesideMm; };
  const auto right = [&](const Sample1& s) { return s.t > vertex + kBesideMm; };
  if (std::count_if(seen.samples.begin(), seen.samples.end(), left) < 2 ||
      std::count_if(seen.samples.begin(), seen.samples.end(), right) < 2)
    return {unseen("flange tip"), 0};
  const double height =
      highest->y() + fit->value + fit->slope * vertex + fit->curvature * vertex * vertex / 2;
  const double sigma = sigma_at(*fit, seen, 2, vertex, placed.registration);
  return {{"", height, sigma, highest->x() + vertex}, highest->x() + vertex};
}

/// Whether the section has points about a place that lie well inside their stripes.
bool well_seen(const PlacedSection& placed, const Vector2d& place) {
  constexpr double kAboutMm = 1.6, kGood = 0.5;
  return std::any_of(placed.points.begin(), placed.points.end(), [&](const Vector2d& p) {
    return (p - place).norm() < kAboutMm && unplaced(placed, p).weight > kGood;
  });
}

/// Where the stripes of the sensors on either side of the tip end near it, both see it too low. Then the
/// wider surroundings tell where it is, by their difference to the reference, unless the tip's own shape
/// contradicts them.
Tip find_tip(const PlacedSection& placed) {
  constexpr double kHalfWidthMm = 5, kSmoothMm = 0.03, kAgreesMm = 0.05, kDerivativeMm = 0.5;
  Tip itself = find_tip_itself(placed);
  const Vector2d top(placed.reference.top_u(), 0), up(0, 1);
  const SurfaceFit around = fit_surface(placed, {top, up, -kHalfWidthMm, kHalfWidthMm, 60, 2});
  const auto before = placed.reference.surface_along(top, up, kDerivativeMm);
  const auto after = placed.reference.surface_along(top, up, -kDerivativeMm);
  if (!itself.height.known() || well_seen(placed, {itself.u, itself.height.value})) return itself;
  if (!around.known() || around.rms_mm > kSmoothMm || !before || !after) return itself;
  const double curvature =
      (*before + *after - 2 * placed.reference.top_v()) / (kDerivativeMm * kDerivativeMm);
  if (curvature >= 0) return itself;
  const double vertex = -around.slope / curvature;  // across: towards the wheel's back
  const double height = around.along_mm + around.slope * vertex / 2;
  if (std::abs(height - itself.height.value) > kAgreesMm) return itself;
  return {{"", height, around.local_sigma_mm, top.x() - vertex}, top.x() - vertex};
}

/// u of the flange's face towards the tread at a height, of the points next to it.
Place face_itself(const PlacedSection& placed, double v, double half_height_mm, double tip_u,
                  const std::string& what) {
  constexpr double kWidestMm = 30;
  SeenPoints seen;
  bool above = false, below = false;
  for (const Vector2d& p : placed.points)
    if (p.x() > tip_u && p.x() < tip_u + kWidestMm && std::abs(p.y() - v) < half_height_mm) {
      seen.add(placed, p, p.y() - v, p.x() - tip_u);
      (p.y() < v ? below : above) = true;
    }
  if (!above || !below) return unseen(what);
  const int degree = seen.samples.size() >= 6 ? 2 : 1;
  return place_from(seen, degree, tip_u, -v, placed, what);
}

/// The same at the height of a place, whose error shifts it along the face.
Place face_at(const PlacedSection& placed, const Place& height, double over_mm, double half_height_mm,
              double tip_u, const std::string& what) {
  const double v = height.value + over_mm;
  Place face = face_itself(placed, v, half_height_mm, tip_u, what);
  const SurfaceFit around = fit_surface(placed, {{tip_u, v}, {1, 0}, -2, 1, 30, 2});
  if (!around.known()) return face;
  // Against the height's place the face rises where the section is turned.
  face.sigma = std::hypot(face.sigma, around.slope * height.sigma);
  face.per_turn += around.slope * (height.per_turn - face.value);
  return face;
}

Estimate difference(const Place& a, const Place& b, const Registration& registration) {
  if (!a.known()) return Estimate::unknown(a.reason);
  if (!b.known()) return Estimate::unknown(b.reason);
  const double turn = std::sqrt(registration.covariance(0, 0));
  return Estimate::known(a.value - b.value, std::hypot(a.sigma, b.sigma, (a.per_turn - b.per_turn) * turn));
}

/// The median height of a strip of the tread.
Place strip_height(const PlacedSection& placed, double u, double half_width_mm) {
  constexpr double kMedianLoss = 1.57;  // pi / 2: variance of a median over that of a mean
  std::vector<double> heights, places;
  for (const Vector2d& p : placed.points)
    if (std::abs(p.x() - u) < half_width_mm && std::abs(p.y()) < 20)
      heights.push_back(p.y()), places.push_back(p.x());
  if (heights.empty()) return unseen("tread");
  ErrorAlong error = placed.registration.error;
  if (places.size() > 2) error.own_mm *= std::sqrt(kMedianLoss);
  error.own_mm = std::max(error.own_mm, kMinScaleMm);
  const std::vector<double> shares(places.size(), 1 / static_cast<double>(places.size()));
  return {"", median(heights), sigma_of_sum(error, places, shares), u};
}

/// The summit or the bottom near a strip that is the highest or lowest: of a parabola over its surroundings.
Place extremum_near(const PlacedSection& placed, const Place& strip) {
  constexpr double kHalfWidthMm = 4, kFarthestMm = 2;
  const double u = strip.per_turn;
  SeenPoints seen;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d arm = placed.points[i] - Vector2d(u, strip.value);
    if (std::abs(arm.x()) < kHalfWidthMm && std::abs(arm.y()) < kHalfWidthMm)
      seen.add(placed, placed.points[i], arm.x(), arm.y());
  }
  const auto fit = fit_polynomial(seen.samples, 2, kMinScaleMm);
  if (!fit || fit->curvature == 0) return strip;
  const double at = -fit->slope / fit->curvature;
  if (std::abs(at) > kFarthestMm) return strip;
  return {"", strip.value + fit->value + fit->slope * at / 2,
          sigma_at(*fit, seen, 2, at, placed.registration), u + at};
}

/// How far the tread lies below its highest point on the field side, which medians of strips find.
Estimate hollow_of(const PlacedSection& placed) {
  constexpr double kFirstU = -20, kFieldU = 15, kLastU = 50, kSeenU = 36, kStripMm = 2;
  std::vector<Place> strips;  // which move by their u where the section is turned
  for (double u = kFirstU; u <= kLastU; u += kStripMm)
    if (const Place strip = strip_height(placed, u, kStripMm / 2); strip.known()) strips.push_back(strip);
  if (strips.size() < 20 || strips.back().per_turn < kSeenU)
    return Estimate::unknown("tread not seen to the field side");
  const Place* high = nullptr;
  for (const Place& strip : strips)
    if (strip.per_turn >= kFieldU && (!high || strip.value > high->value)) high = &strip;
  const Place* low = high;
  for (const Place& strip : strips)
    if (strip.per_turn < high->per_turn && strip.value < low->value) low = &strip;
  if (low == high) return difference(*high, *low, placed.registration);
  return difference(extremum_near(placed, *high), extremum_near(placed, *low), placed.registration);
}

Estimate rim_width(const PlacedSection& placed, const Place& back) {
  constexpr double kNarrowestU = 55, kWidestU = 80, kBelowChamferMm = 9, kFewest = 8, kUprightMm = 0.3;
  SeenPoints outer;
  for (const Vector2d& p : placed.points)
    if (p.x() > kNarrowestU && p.x() < kWidestU && p.y() < -kBelowChamferMm && p.y() > -50)
      outer.add(placed, p, p.y() + 20, p.x());
  if (static_cast<double>(outer.samples.size()) < kFewest) return Estimate::unknown("outer face not seen");
  const auto fit = fit_polynomial(outer.samples, 0, kMinScaleMm);
  // What bends away is the rounded rim, no face.
  if (!fit || fit->rms > kUprightMm) return Estimate::unknown("outer face not seen");
  for (Sample1& s : outer.samples) s.t -= 20;
  const Place face = place_from(outer, 0, 0, -mean_of_places(outer.samples), placed, "outer face");
  return difference(face, back, placed.registration);
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

/// Why the wheel is no worn one of the reference, laid with its flange's tip on the reference's; empty if
/// nothing speaks against it. Tip and back of the flange do not wear, nor does the tread at the rim's edge.
std::string why_another_wheel(const PlacedSection& placed, const Tip& tip, double wear) {
  constexpr double kFitsMm = 0.3, kFar = 10, kBelowTipMm = 8, kEdgeFrom = 45, kEdgeTo = 58;
  constexpr std::size_t kEnough = 10;
  constexpr double kWornMm = 0.5, kShareOfWear = 0.85;
  const Vector2d to_tip(0, placed.reference.top_v() - tip.height.value);
  std::vector<double> flange, edge;
  for (const Vector2d& p : placed.points) {
    const Vector2d moved = p + to_tip;
    const auto foot = placed.reference.nearest(moved);
    const bool on_flange = moved.x() < tip.u && moved.y() > placed.reference.top_v() - kBelowTipMm;
    if (on_flange) flange.push_back(foot ? std::abs(foot->signed_distance) : kFar);
    const bool on_edge = p.x() > kEdgeFrom && p.x() < kEdgeTo && std::abs(p.y()) < 20;
    const auto nominal = on_edge ? placed.reference.surface_along({p.x(), 0}, {0, 1}, 0) : std::nullopt;
    if (nominal) edge.push_back(*nominal - moved.y());
  }
  const std::string& name = placed.reference.name();
  if (flange.size() >= kEnough && median(flange) > kFitsMm)
    return fmt::format("the flange's top does not fit {} ({:.2f} mm): name the wheel", name, median(flange));
  if (wear > kWornMm && edge.size() >= kEnough && median(edge) > kShareOfWear * wear)
    return fmt::format("the tread is {:.1f} mm lower than {}'s out to the rim: name the wheel", wear, name);
  return "";
}

Estimate tread_wear_of(const PlacedSection& placed, const Tip& tip, const Estimate& flange_height,
                       double datum_u) {
  const auto nominal = placed.reference.surface_along({datum_u, 0}, {0, 1}, 0);
  if (!flange_height.value || !nominal) return flange_height;
  const double wear = *flange_height.value - (placed.reference.top_v() - *nominal);
  const std::string other = why_another_wheel(placed, tip, wear);
  if (!other.empty()) return Estimate::unknown(other);
  Estimate out = flange_height;
  out.value = wear;
  return out;
}

/// Where the wheel stands about its axis, for its run-out.
void add_places(const Place& tread, const Place& back, const Registration& registration,
                const WheelSectionKind& kind, WheelMeasurement& out) {
  out.radius = out.back_place = Estimate::unknown("v is no radius: not a rotary scan");
  if (!kind.radial) return;
  const Vector2d& shift = registration.reference_from_section.move.translation;
  out.back_place = Estimate::known(back.value - shift.x(), back.sigma);
  out.radius =
      tread.known() ? Estimate::known(tread.value - shift.y(), tread.sigma) : Estimate::unknown(tread.reason);
}

}  // namespace

WheelMeasurement measure_wheel(const Section& section, const ReferenceShape& reference,
                               const Registration& registration, const WheelSectionKind& kind,
                               const WheelOptions& options) {
  WheelMeasurement out;
  if (!registration.usable()) {
    visit_estimates(
        [&](const char*, Estimate& estimate) { estimate = Estimate::unknown(registration.reason); }, out);
    out.radius = out.back_place = Estimate::unknown(registration.reason);
    return out;
  }
  const PlacedSection placed = place(section, reference, registration);
  const Place back = find_back(placed, kind);
  const double datum_u = back.value + options.datum_mm;
  const Place tread = tread_height(placed, datum_u);
  const Tip tip = find_tip(placed);
  out.flange_height = difference(tip.height, tread, registration);
  out.hollow = hollow_of(placed);
  out.rim_width = rim_width(placed, back);
  out.diameter = diameter_of(tread, registration, kind);
  add_places(tread, back, registration, kind, out);
  out.tread_wear = tread_wear_of(placed, tip, out.flange_height, datum_u);
  if (!tread.known() || !tip.height.known()) {
    out.flange_thickness = out.qr = Estimate::unknown(tread.known() ? tip.height.reason : tread.reason);
    return out;
  }
  const Place face = face_at(placed, tread, options.face_height_mm, 1.0, tip.u, "flange face");
  const Place upper =
      face_at(placed, tip.height, -options.qr_below_tip_mm, 0.8, tip.u, "flange below its tip");
  out.flange_thickness = difference(face, back, registration);
  out.qr = difference(face, upper, registration);
  return out;
}

}  // namespace lightstripe
