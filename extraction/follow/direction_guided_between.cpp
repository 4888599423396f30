// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided_between.h"

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

}  // namespace lightstripe
