// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Outlines made of others, and the section properties of closed ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/outline.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

// Gauss-Legendre nodes and weights of order 8 on [-1, 1] (Abramowitz and Stegun, table 25.4)
constexpr std::array<double, 4> kNode{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                      0.9602898564975363};
constexpr std::array<double, 4> kWeight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                        0.1012285362903763};

/// The moments of the area left of the passage as line integrals of u^a v^b dv (Green).
struct Moments {
  double area = 0, u = 0, v = 0, uu = 0, vv = 0;

  void add(const Vector2d& p, double dv) {
    area += p.x() * dv;
    u += p.x() * p.x() / 2 * dv;
    v += p.x() * p.y() * dv;
    uu += p.x() * p.x() * p.x() / 3 * dv;
    vv += p.x() * p.y() * p.y() * dv;
  }
};

void add_segment(const OutlineSegment& segment, Moments& sum) {
  const double whole = length(segment);
  // An eighth of a turn a piece keeps the quadrature's error below rounding.
  const double pieces = segment.straight() ? 1 : std::ceil(whole / segment.radius / (std::numbers::pi / 4));
  for (int piece = 0; piece < static_cast<int>(pieces); ++piece)
    for (std::size_t k = 0; k < 2 * kNode.size(); ++k) {
      const double node = k % 2 == 0 ? kNode[k / 2] : -kNode[k / 2];
      const double t = (piece + 0.5 * (1 + node)) / pieces;
      const double dv_dt = normal_at(segment, t).x() * whole;  // the tangent is the normal turned left
      sum.add(point_at(segment, t), kWeight[k / 2] * 0.5 / pieces * dv_dt);
    }
}

Moments moments_of(const Outline& outline) {
  Moments sum;
  for (const OutlineSegment& segment : outline.segments) add_segment(segment, sum);
  return sum;
}

OutlineSegment backwards(const OutlineSegment& segment) {
  OutlineSegment out = segment;
  std::swap(out.from, out.to);
  out.counterclockwise = !segment.counterclockwise;
  return out;
}

OutlineSegment mirror(const OutlineSegment& segment) {
  OutlineSegment out = segment;
  out.from.x() = -out.from.x();
  out.to.x() = -out.to.x();
  out.center.x() = -out.center.x();
  out.counterclockwise = !segment.counterclockwise;
  return out;
}

Outline made_counterclockwise(const Outline& outline) {
  return moments_of(outline).area < 0 ? reversed(outline) : outline;
}

}  // namespace

Outline reversed(const Outline& outline) {
  Outline out;
  for (auto it = outline.segments.rbegin(); it != outline.segments.rend(); ++it)
    out.segments.push_back(backwards(*it));
  return out;
}

Outline mirrored(const Outline& half) {
  Outline out = half;
  for (auto it = half.segments.rbegin(); it != half.segments.rend(); ++it)
    out.segments.push_back(mirror(backwards(*it)));
  return made_counterclockwise(out);
}

Outline circle_outline(double radius) {
  OutlineSegment upper = arc_segment({radius, 0}, {-radius, 0}, {0, 0});
  OutlineSegment lower = arc_segment({-radius, 0}, {radius, 0}, {0, 0});
  upper.counterclockwise = lower.counterclockwise = true;  // half a turn has no shorter side
  return {{upper, lower}};
}

Outline polygon_outline(const std::vector<Vector2d>& corners) {
  LIGHTSTRIPE_CHECK(corners.size() >= 3, "a polygon has at least three corners");
  Outline out;
  for (std::size_t i = 0; i < corners.size(); ++i)
    out.segments.push_back(line_segment(corners[i], corners[(i + 1) % corners.size()]));
  return made_counterclockwise(out);
}

SectionProperties section_properties(const Outline& outline) {
  LIGHTSTRIPE_CHECK(outline.closed(), "section properties need a closed outline");
  const Moments sum = moments_of(outline);
  SectionProperties out;
  out.area = sum.area;
  out.centroid = {sum.u / sum.area, sum.v / sum.area};
  out.inertia_u = sum.vv - sum.area * out.centroid.y() * out.centroid.y();
  out.inertia_v = sum.uu - sum.area * out.centroid.x() * out.centroid.x();
  return out;
}

}  // namespace lightstripe
