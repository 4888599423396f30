// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kArcEndMm = 2e-5;  // tabulated ends lie that far off their arc

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Signed angle of passage, radians, positive counterclockwise.
double sweep(const OutlineSegment& arc) {
  const Vector2d a = arc.from - arc.center, b = arc.to - arc.center;
  double angle = std::atan2(cross(a, b), a.dot(b));
  if (arc.counterclockwise && angle <= 0) angle += 2 * std::numbers::pi;
  if (!arc.counterclockwise && angle >= 0) angle -= 2 * std::numbers::pi;
  return angle;
}

/// Direction from the arc's centre at share t.
Vector2d radial_at(const OutlineSegment& arc, double t) {
  const Vector2d a = (arc.from - arc.center).normalized();
  const double angle = t * sweep(arc), c = std::cos(angle), s = std::sin(angle);
  return {c * a.x() - s * a.y(), s * a.x() + c * a.y()};
}

/// Whether a point of the arc's circle lies on the arc: a counterclockwise arc lies right of its chord.
bool on_arc_side(const OutlineSegment& arc, const Vector2d& point) {
  const Vector2d chord = arc.to - arc.from;
  const double side = cross(chord, point - arc.from), slack = kArcEndMm * chord.norm();
  return arc.counterclockwise ? side <= slack : side >= -slack;
}

/// Keeps the nearer of the two crossings.
void keep_nearer(std::optional<OutlineHit>& nearest, double s, const Vector2d& normal, std::size_t segment) {
  if (!nearest || s < nearest->s) nearest = OutlineHit{s, normal, static_cast<int>(segment)};
}

struct LineOfSight {
  Vector2d origin, direction;
  double min_s;
};

void cross_line(const OutlineSegment& line, const LineOfSight& ray, std::size_t index,
                std::optional<OutlineHit>& nearest) {
  const double from_side = cross(ray.direction, line.from - ray.origin);
  const double to_side = cross(ray.direction, line.to - ray.origin);
  if ((from_side > 0 && to_side > 0) || (from_side < 0 && to_side < 0) || from_side == to_side) return;
  const Vector2d along = line.to - line.from;
  const Vector2d point = line.from + along * (from_side / (from_side - to_side));
  const double s = (point - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
  if (s > ray.min_s) keep_nearer(nearest, s, Vector2d(along.y(), -along.x()).normalized(), index);
}

void cross_arc(const OutlineSegment& arc, const LineOfSight& ray, std::size_t index,
               std::optional<OutlineHit>& nearest) {
  const Vector2d to_center = arc.center - ray.origin;
  const double a = ray.direction.squaredNorm(), offset = cross(ray.direction, to_center);
  const double discriminant = a * arc.radius * arc.radius - offset * offset;
  if (discriminant < 0) return;
  const double middle = to_center.dot(ray.direction), half = std::sqrt(discriminant);
  for (const double s : {(middle - half) / a, (middle + half) / a}) {
    if (s <= ray.min_s || (nearest && s >= nearest->s)) continue;
    const Vector2d point = ray.origin + s * ray.direction;
    if (!on_arc_side(arc, point)) continue;
    const Vector2d outwards = (point - arc.center) / arc.radius;
    keep_nearer(nearest, s, arc.counterclockwise ? outwards : Vector2d(-outwards), index);
    return;
  }
}

/// Share of the segment's length at which it comes nearest to the point.
double nearest_share(const OutlineSegment& segment, const Vector2d& point) {
  if (segment.straight()) {
    const Vector2d along = segment.to - segment.from;
    return std::clamp((point - segment.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  }
  const Vector2d a = segment.from - segment.center, b = point - segment.center;
  const double full = sweep(segment), turn = segment.counterclockwise ? 1 : -1;
  double angle = turn * std::atan2(cross(a, b), a.dot(b));
  if (angle < 0) angle += 2 * std::numbers::pi;
  if (angle <= std::abs(full)) return angle / std::abs(full);
  return (point - segment.from).squaredNorm() <= (point - segment.to).squaredNorm() ? 0.0 : 1.0;
}

/// Angle under which a point sees the segment pass, radians.
double seen_angle(const OutlineSegment& segment, const Vector2d& point) {
  const Vector2d a = segment.from - point, b = segment.to - point;
  const double angle = std::atan2(cross(a, b), a.dot(b));
  if (segment.straight() || (point - segment.center).norm() >= segment.radius) return angle;
  // From within its circle an arc is seen to turn in its own sense only, the long way round if need be.
  if (segment.counterclockwise) return angle <= 0 ? angle + 2 * std::numbers::pi : angle;
  return angle >= 0 ? angle - 2 * std::numbers::pi : angle;
}

}  // namespace

OutlineSegment line_segment(const Vector2d& from, const Vector2d& to) {
  OutlineSegment out;
  out.from = from;
  out.to = to;
  return out;
}

OutlineSegment arc_segment(const Vector2d& from, const Vector2d& to, const Vector2d& center) {
  OutlineSegment out = line_segment(from, to);
  out.center = center;
  out.radius = 0.5 * ((from - center).norm() + (to - center).norm());
  out.counterclockwise = cross(from - center, to - center) > 0;
  return out;
}

bool Outline::closed() const {
  return !segments.empty() && (segments.front().from - segments.back().to).norm() < kOutlineJointMm;
}

double length(const OutlineSegment& segment) {
  return segment.straight() ? (segment.to - segment.from).norm() : segment.radius * std::abs(sweep(segment));
}

Vector2d point_at(const OutlineSegment& segment, double t) {
  if (segment.straight()) return segment.from + t * (segment.to - segment.from);
  return segment.center + segment.radius * radial_at(segment, t);
}

Vector2d normal_at(const OutlineSegment& segment, double t) {
  if (!segment.straight()) return segment.counterclockwise ? radial_at(segment, t) : -radial_at(segment, t);
  const Vector2d along = (segment.to - segment.from).normalized();
  return {along.y(), -along.x()};
}

std::vector<OutlineSample> sample(const Outline& outline, double spacing_mm) {
  LIGHTSTRIPE_CHECK(spacing_mm > 0, "the spacing of samples must be positive");
  std::vector<OutlineSample> out;
  double before = 0;
  for (std::size_t i = 0; i < outline.segments.size(); ++i) {
    const OutlineSegment& segment = outline.segments[i];
    const double whole = length(segment);
    const int steps = std::max(1, static_cast<int>(std::ceil(whole / spacing_mm)));
    const bool last = i + 1 == outline.segments.size() && !outline.closed();
    for (int k = 0; k < steps + (last ? 1 : 0); ++k) {
      const double t = static_cast<double>(k) / steps;
      out.push_back({point_at(segment, t), normal_at(segment, t), before + t * whole, static_cast<int>(i)});
    }
    before += whole;
  }
  return out;
}

std::optional<OutlineHit> first_hit(const Outline& outline, const Vector2d& origin, const Vector2d& direction,
                                    double min_s) {
  const LineOfSight ray{origin, direction, min_s};
  std::optional<OutlineHit> nearest;
  for (std::size_t i = 0; i < outline.segments.size(); ++i) {
    const OutlineSegment& segment = outline.segments[i];
    if (segment.straight())
      cross_line(segment, ray, i, nearest);
    else
      cross_arc(segment, ray, i, nearest);
  }
  return nearest;
}

bool contains(const Outline& outline, const Vector2d& point) {
  double turned = 0;
  for (const OutlineSegment& segment : outline.segments) turned += seen_angle(segment, point);
  return std::abs(turned) > std::numbers::pi;
}

OutlineFoot closest_point(const Outline& outline, const Vector2d& point) {
  LIGHTSTRIPE_CHECK(!outline.segments.empty(), "an empty outline has no nearest point");
  OutlineFoot best;
  for (std::size_t i = 0; i < outline.segments.size(); ++i) {
    const OutlineSegment& segment = outline.segments[i];
    const double t = nearest_share(segment, point);
    const Vector2d foot = point_at(segment, t);
    const double distance = (point - foot).norm();
    if (i == 0 || distance < best.distance)
      best = {foot, normal_at(segment, t), distance, static_cast<int>(i)};
  }
  return best;
}

}  // namespace lightstripe
