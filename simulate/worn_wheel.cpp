// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/worn_wheel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kFaceU = -36, kTreadU = -22;  // the flange's wear fades out between them towards the tread
constexpr double kFaceV = 12;                  // and from here to the tip's height
constexpr double kRunningEndU = 60;            // of the tread, where the chamfer begins
constexpr double kHollowHalf = 30;             // half the width of the tread's hollow

/// 1 below `low`, 0 above `high`, smooth between.
double fading(double x, double low, double high) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

Vector2d worn_point(const Vector2d& p, double tip_v, const WheelWear& wear) {
  const double sunk =
      std::abs(p.x()) < kHollowHalf ? 0.5 * (1 + std::cos(std::numbers::pi * p.x() / kHollowHalf)) : 0;
  const double moved = fading(p.x(), kFaceU, kTreadU) * fading(p.y(), kFaceV, tip_v);
  return {p.x() - wear.flange_mm * moved, p.y() - wear.tread_mm * sunk};
}

std::vector<Vector2d> points_of(const Outline& outline, double spacing_mm) {
  std::vector<Vector2d> points;
  for (const OutlineSample& s : sample(outline, spacing_mm)) points.push_back(s.position);
  return points;
}

std::size_t highest(const std::vector<Vector2d>& points) {
  const auto lower = [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); };
  return static_cast<std::size_t>(std::max_element(points.begin(), points.end(), lower) - points.begin());
}

/// The polygon of what is left: outer face, tread and active face as worn up to the tip, the back as it was.
std::vector<Vector2d> worn_points(const Outline& nominal, const WheelWear& wear, double spacing_mm) {
  std::vector<Vector2d> points = points_of(nominal, spacing_mm);
  const std::size_t tip = highest(points);
  const double tip_v = points[tip].y();
  double face_u = kRunningEndU;  // what wears the face leaves nothing above that would stand out over it
  for (std::size_t i = 0; i < tip; ++i) {
    if (points[i].y() < -20 || points[i].x() > kRunningEndU) continue;  // outer face and chamfer
    points[i] = worn_point(points[i], tip_v, wear);
    points[i].x() = face_u = std::min(points[i].x(), face_u);
  }
  return points;
}

/// u where the section's active face has this height, seen from the tip downwards.
double face_at(const std::vector<Vector2d>& points, double v) {
  for (std::size_t i = highest(points); i > 0; --i) {
    const Vector2d &high = points[i], &low = points[i - 1];
    if (low.y() > v || high.y() < v) continue;
    return low.x() + (v - low.y()) / (high.y() - low.y()) * (high.x() - low.x());
  }
  throw Error("wheel: profile", "has no flange face", "give a wheel's outline");
}

/// v of the tread at u.
double tread_at(const std::vector<Vector2d>& points, double u) {
  const std::size_t tip = highest(points);
  for (std::size_t i = 1; i <= tip; ++i) {
    const Vector2d &right = points[i - 1], &left = points[i];
    if (right.x() < u || left.x() > u || right.x() == left.x() || right.y() < -20) continue;
    return left.y() + (u - left.x()) / (right.x() - left.x()) * (right.y() - left.y());
  }
  throw Error("wheel: profile", "has no tread at its datum", "give a wheel's outline");
}

}  // namespace

Outline worn_wheel(const Outline& nominal, const WheelWear& wear, double spacing_mm) {
  if (wear.flange_mm == 0 && wear.tread_mm == 0) return nominal;
  if (wear.flange_mm > 12)
    throw Error("wheel.flange_wear_mm", "leaves nothing of the flange's tip", "give 12 or less");
  const std::vector<Vector2d> points = worn_points(nominal, wear, spacing_mm);
  Outline out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d& next = points[(i + 1) % points.size()];
    if ((next - points[i]).norm() > 1e-9) out.segments.push_back(line_segment(points[i], next));
  }
  return out;
}

WheelDimensions measure_wheel_section(const Outline& section) {
  constexpr double kSpacing = 0.01;  // its chords leave the smallest arc (R12) by 1e-6 mm
  const std::vector<Vector2d> points = points_of(section, kSpacing);
  const auto [back, front] = std::minmax_element(
      points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  const double datum = tread_at(points, 0), tip = points[highest(points)].y();
  WheelDimensions out;
  out.flange_height = tip - datum;
  out.flange_thickness = face_at(points, datum + 10) - back->x();
  out.qr = face_at(points, datum + 10) - face_at(points, tip - 2);
  out.rim_width = front->x() - back->x();
  double highest_so_far = -1e9;  // from the field side inwards
  for (const Vector2d& p : points) {
    if (p.y() < -20) continue;
    if (p.x() < -26) break;
    highest_so_far = std::max(highest_so_far, p.y());
    out.hollow = std::max(out.hollow, highest_so_far - p.y());
  }
  return out;
}

}  // namespace lightstripe
