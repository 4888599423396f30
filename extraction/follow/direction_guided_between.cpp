// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided_between.h"

#include <cmath>

namespace lightstripe {

void append_between(const RidgePlace& a, const RidgePlace& b, int steps, std::vector<StripePoint>& out) {
  const bool column_wise = a.direction.column_wise();
  const auto slope = [column_wise](const Direction& d) { return column_wise ? d.y / d.x : d.x / d.y; };
  const double from = column_wise ? a.x : a.y, span = column_wise ? b.x - a.x : b.y - a.y;
  const double start = column_wise ? a.y : a.x, end = column_wise ? b.y : b.x;
  // across = start + u (c1 + u (c2 + u c3))
  const double c1 = slope(a.direction) * span, slope_b = slope(b.direction) * span;
  const double c2 = 3 * (end - start) - 2 * c1 - slope_b, c3 = c1 + slope_b - 2 * (end - start);
  const double turn_x = b.direction.x - a.direction.x, turn_y = b.direction.y - a.direction.y;
  const double turn = turn_x * turn_x + turn_y * turn_y, step = 1.0 / steps;
  for (int k = 1; k < steps; ++k) {
    const double u = k * step, v = 1 - u;
    const double along = from + u * span;  // a need not be whole-numbered where the octant changed
    const double across = start + u * (c1 + u * (c2 + u * c3));
    const double scale = length_correction(turn, u);
    StripePoint& p = out.emplace_back();
    p.x = column_wise ? along : across;
    p.y = column_wise ? across : along;
    p.normal_x = -scale * (a.direction.y + u * turn_y);
    p.normal_y = scale * (a.direction.x + u * turn_x);
    p.strength = v * a.strength + u * b.strength;
  }
}

namespace {

StripePoint in_full_image(StripePoint p, int shift) {
  const double bin = 1 << shift;
  p.x = (p.x + 0.5) * bin - 0.5;
  p.y = (p.y + 0.5) * bin - 0.5;
  p.strength /= bin * bin;
  return p;
}

/// Between two points at `u`, with the directions that their normals give.
StripePoint between(const StripePoint& a, const StripePoint& b, double u, double span_x, double span_y) {
  // Hermite's cubic; tangents have the chord's length.
  const double length = std::hypot(span_x, span_y), v = 1 - u;
  const double sign = a.normal_y * span_x - a.normal_x * span_y >= 0 ? length : -length;
  const double h0 = v * v * (1 + 2 * u), h1 = u * u * (3 - 2 * u), t0 = u * v * v * sign,
               t1 = -u * u * v * sign;
  StripePoint p = u < 0.5 ? a : b;
  p.x = h0 * a.x + h1 * b.x + t0 * a.normal_y + t1 * b.normal_y;
  p.y = h0 * a.y + h1 * b.y - t0 * a.normal_x - t1 * b.normal_x;
  const double nx = v * a.normal_x + u * b.normal_x, ny = v * a.normal_y + u * b.normal_y;
  const double scale = 1 / std::max(std::hypot(nx, ny), 1e-9);
  p.normal_x = nx * scale;
  p.normal_y = ny * scale;
  p.strength = v * a.strength + u * b.strength;
  p.flags = a.flags | b.flags;
  return p;
}

}  // namespace

void append_in_full_image(std::span<const StripePoint> binned, int shift, std::vector<StripePoint>& out) {
  const double longest = 3.0 * (1 << shift);  // px; over longer steps the line is dark
  for (std::size_t i = 0; i + 1 < binned.size(); ++i) {
    const StripePoint a = in_full_image(binned[i], shift), b = in_full_image(binned[i + 1], shift);
    const double dx = b.x - a.x, dy = b.y - a.y;
    if (dx * dx + dy * dy > longest * longest) continue;
    const bool columns = std::abs(a.normal_y) >= std::abs(a.normal_x);
    const double from = columns ? a.x : a.y, to = columns ? b.x : b.y;
    const double step = to >= from ? 1.0 : -1.0;
    // Whole-numbered columns from a (included) to b (left for the next pair).
    for (double at = step > 0 ? std::ceil(from) : std::floor(from); step * (to - at) > 0; at += step) {
      StripePoint p = between(a, b, (at - from) / (to - from), dx, dy);
      (columns ? p.x : p.y) = at;
      out.push_back(p);
    }
  }
}

}  // namespace lightstripe
