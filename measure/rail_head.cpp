// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/rail_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/robust.h"
#include "measure/robust_line.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kSectorRad = std::numbers::pi / 180;
constexpr double kCentreDepthMm = 20;  // of the sectors' centre below the top

/// Without the points that glare has spoilt.
std::vector<Vector2d> trusted_points(const PlacedSection& placed) {
  constexpr double kTrusted = 0.02;
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < placed.points.size(); ++i)
    if (placed.section[i].weight > kTrusted) out.push_back(placed.points[i]);
  return out;
}

/// The same in coordinates across and along `up`.
std::vector<Vector2d> upright_points(const PlacedSection& placed, const Vector2d& up) {
  std::vector<Vector2d> points = trusted_points(placed);
  for (Vector2d& p : points) p = Vector2d(p.x() * up.y() - p.y() * up.x(), p.dot(up));
  return points;
}

/// Medians of the heights in strips of the head, where there are points.
std::vector<Sample1> strip_heights(const std::vector<Vector2d>& points, double top_v, double half_width_mm) {
  constexpr double kStripMm = 2, kDepthMm = 14;
  std::vector<Sample1> out;
  for (double u = -half_width_mm; u <= half_width_mm; u += kStripMm) {
    std::vector<double> heights;
    for (const Vector2d& p : points)
      if (std::abs(p.x() - u) < kStripMm / 2 && std::abs(p.y() - top_v) < kDepthMm) heights.push_back(p.y());
    if (heights.size() >= 2) out.push_back({u, median(heights)});
  }
  return out;
}

/// A sector of the head: half the difference of the squared radii of reference and measurement, its median.
struct Sector {
  std::vector<double> differences;
  std::optional<double> value;
};

std::optional<double> reference_radius(const PlacedSection& placed, const Vector2d& centre, double angle) {
  const Vector2d direction(std::cos(angle), std::sin(angle));
  const auto hit = first_hit(placed.reference.outline(), centre, direction, 0);
  if (!hit) return std::nullopt;
  return hit->s;
}

/// Bridges holes (glare) of at most eight sectors, some 4 mm, in a straight way. Returns the variance of what
/// is summed over them: between its two sides a hole's mean may lie anywhere. Nothing if there is a larger
/// hole.
std::optional<double> bridge_holes(std::vector<Sector>& sectors) {
  constexpr int kLargestHole = 8;
  const int n = static_cast<int>(sectors.size());
  double variance = 0;
  int last = -1;
  for (int i = 0; i <= n; ++i) {
    if (i < n && !sectors[static_cast<std::size_t>(i)].value) continue;
    const int hole = i - last - 1;
    if (hole > kLargestHole || hole == n) return std::nullopt;
    for (int k = last + 1; k < i; ++k) {
      const double before = last >= 0 ? *sectors[static_cast<std::size_t>(last)].value
                                      : *sectors[static_cast<std::size_t>(i)].value;
      const double after = i < n ? *sectors[static_cast<std::size_t>(i)].value : before;
      sectors[static_cast<std::size_t>(k)].value = before + (after - before) * (k - last) / (hole + 1);
      if (k == i - 1) variance += std::pow(hole * (after - before), 2) / 12;
    }
    last = i;
  }
  return variance;
}

/// Variance of the area by the points' scatter: each sector is the median of its points. Errors that a
/// stretch of surface shares count in full over the stretch (the 8 mm of stretch_error_mm).
double area_noise(const PlacedSection& placed, const std::vector<Sector>& sectors, const Vector2d& centre,
                  double width) {
  constexpr double kMedianLoss = 1.57;  // pi / 2: variance of a median over that of a mean
  constexpr double kStretchMm = 8;
  double radius = 0, count = 0;
  for (const Vector2d& p : trusted_points(placed))
    if (p.y() > placed.reference.head_bottom_v()) radius += (p - centre).norm(), count += 1;
  const double arc = width * radius / std::max(1.0, count);  // of a sector's surface
  double scatter = 0;
  for (const Sector& sector : sectors) {
    const auto n = static_cast<double>(std::max<std::size_t>(1, sector.differences.size()));
    scatter += arc * arc / n * (n > 2 ? kMedianLoss : 1);
  }
  const double rms = placed.registration.rms_mm, stretch = placed.registration.stretch_error_mm;
  const double length = arc * static_cast<double>(sectors.size());
  return std::max(scatter * rms * rms * placed.registration.correlated_points,
                  stretch * stretch * kStretchMm * length);
}

}  // namespace

HeadTop find_head_top(const PlacedSection& placed, const Vector2d& up) {
  constexpr double kHalfWidthMm = 25, kAroundMm = 6;
  const std::vector<Vector2d> points = upright_points(placed, up);
  const std::vector<Sample1> strips = strip_heights(points, placed.reference.top_v(), kHalfWidthMm);
  HeadTop top;
  if (strips.size() < 5) {
    top.reason = "top of the head not seen";
    return top;
  }
  const Sample1 highest = *std::max_element(
      strips.begin(), strips.end(), [](const Sample1& a, const Sample1& b) { return a.value < b.value; });
  const double end = kHalfWidthMm - 1;
  if (std::abs(highest.t) > end && strips.size() < 20) {
    top.reason = "top of the head not seen";
    return top;
  }
  std::vector<Sample1> around;
  for (const Vector2d& p : points)
    if (std::abs(p.x() - highest.t) < kAroundMm && std::abs(p.y() - highest.value) < 3)
      around.push_back({p.x() - highest.t, p.y() - highest.value});
  const auto fit = fit_polynomial(around, 2, kMinScaleMm);
  if (!fit) {
    top.reason = "top of the head not seen";
    return top;
  }
  const double vertex =
      fit->curvature < 0 ? std::clamp(-fit->slope / fit->curvature, -kAroundMm, kAroundMm) : 0.0;
  top.u = highest.t + vertex;
  top.v = highest.value + fit->value + fit->slope * vertex + fit->curvature * vertex * vertex / 2;
  return top;
}

SurfaceFit fit_head_face(const PlacedSection& placed, const Vector2d& origin, const Vector2d& outwards) {
  constexpr double kLowestMm = 8.5, kHighestMm = 1.5, kReachMm = 60, kStraightMm = 0.02, kAgreesMm = 0.03;
  const SurfaceFit here = fit_surface(placed, {origin, outwards, -1.5, 1.5, kReachMm, 2});
  SurfaceProbe below{origin, outwards, -kLowestMm, -kHighestMm, kReachMm, 1, true};
  if (outwards.x() < 0) below.from_mm = kHighestMm, below.to_mm = kLowestMm;
  const SurfaceFit carried = fit_surface(placed, below);
  const bool agrees = here.known() && carried.known() && carried.rms_mm < kStraightMm &&
                      std::abs(carried.wear_mm - here.wear_mm) < kAgreesMm;
  return agrees ? carried : here;
}

Estimate head_area_loss(const PlacedSection& placed) {
  const ReferenceShape& reference = placed.reference;
  const Vector2d centre(0, reference.top_v() - kCentreDepthMm);
  const auto face = reference.surface_along({0, reference.head_bottom_v() + 0.1}, {1, 0}, 0);
  if (!face) return Estimate::unknown("the reference has no head face");
  const double lowest = std::atan2(reference.head_bottom_v() - centre.y(), *face);  // below the horizontal
  const int count = static_cast<int>(std::ceil((std::numbers::pi - 2 * lowest) / kSectorRad));
  const double width = (std::numbers::pi - 2 * lowest) / count;
  std::vector<Sector> sectors(static_cast<std::size_t>(count));
  for (const Vector2d& p : trusted_points(placed)) {
    const Vector2d arm = p - centre;
    double angle = std::atan2(arm.y(), arm.x());
    if (angle < -std::numbers::pi / 2) angle += 2 * std::numbers::pi;
    const int i = static_cast<int>(std::floor((angle - lowest) / width));
    if (i < 0 || i >= count || arm.norm() > 60) continue;
    const auto radius = reference_radius(placed, centre, angle);
    if (radius && std::abs(*radius - arm.norm()) < 16)
      sectors[static_cast<std::size_t>(i)].differences.push_back((*radius * *radius - arm.squaredNorm()) / 2);
  }
  for (Sector& sector : sectors)
    if (sector.differences.size() >= 1) sector.value = median(sector.differences);
  const auto bridged = bridge_holes(sectors);
  if (!bridged) return Estimate::unknown("head not seen all round");
  double area = 0;
  for (const Sector& sector : sectors) area += *sector.value * width;
  // A shift up by one sigma adds the head's width times it; sideways and turned it nearly cancels.
  const double place = placed.registration.sigma_of({0, reference.top_v()}, {0, 1}) * 2 * *face;
  const double noise = std::sqrt(area_noise(placed, sectors, centre, width));
  return Estimate::known(area, std::hypot(place, noise, width * std::sqrt(*bridged)));
}

Estimate find_lip(const PlacedSection& placed, int side, double lip_mm) {
  constexpr double kBelowFaceMm = 4, kFewest = 3;
  const ReferenceShape& reference = placed.reference;
  std::vector<double> out_of_face;
  for (const Vector2d& p : trusted_points(placed)) {
    if (p.x() * side < 0 || p.y() > reference.top_v() - 2 || p.y() < reference.head_bottom_v() - kBelowFaceMm)
      continue;
    const auto foot = reference.nearest(p);
    if (foot && foot->signed_distance > lip_mm) out_of_face.push_back(foot->signed_distance);
  }
  if (static_cast<double>(out_of_face.size()) < kFewest) return {0.0, std::nullopt, ""};
  std::sort(out_of_face.begin(), out_of_face.end());
  return Estimate::known(out_of_face[out_of_face.size() - 2],
                         placed.registration.rms_mm);  // not the one farthest
}

}  // namespace lightstripe
