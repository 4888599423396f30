// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/bridge.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {

StripePoint bridged_point(const StripePoint& a, const StripePoint& b, double u) {
  const double v = 1 - u, chord = std::hypot(b.x - a.x, b.y - a.y);
  const double h0 = v * v * (1 + 2 * u), h1 = u * u * (1 + 2 * v), g0 = chord * u * v * v,
               g1 = -chord * u * u * v;
  StripePoint p;
  // The tangent is the normal turned back by a right angle.
  p.x = h0 * a.x + h1 * b.x + g0 * a.normal_y + g1 * b.normal_y;
  p.y = h0 * a.y + h1 * b.y - g0 * a.normal_x - g1 * b.normal_x;
  const double nx = v * a.normal_x + u * b.normal_x, ny = v * a.normal_y + u * b.normal_y;
  const double length = std::hypot(nx, ny);
  p.normal_x = nx / length;
  p.normal_y = ny / length;
  p.width = v * a.width + u * b.width;
  p.strength = std::min(a.strength, b.strength);
  p.intensity = static_cast<float>(v * a.intensity + u * b.intensity);
  p.flags = kStripeBridged;
  return p;
}

bool can_bridge(const StripePoint& a, const StripePoint& b) {
  constexpr double kLeastCosine = 0.94;
  const double dx = b.x - a.x, dy = b.y - a.y, chord = std::hypot(dx, dy);
  return chord > 0 && a.normal_y * dx - a.normal_x * dy >= kLeastCosine * chord &&
         b.normal_y * dx - b.normal_x * dy >= kLeastCosine * chord;
}

}  // namespace lightstripe
