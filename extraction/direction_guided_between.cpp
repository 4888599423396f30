// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/direction_guided_between.h"

#include <cmath>

namespace lightstripe {

void append_between(const RidgePlace& a, const RidgePlace& b, int steps, std::vector<StripePoint>& out) {
  const bool column_wise = a.direction.column_wise();
  const auto slope = [column_wise](const Direction& d) { return column_wise ? d.y / d.x : d.x / d.y; };
  const double from = column_wise ? a.x : a.y, span = column_wise ? b.x - a.x : b.y - a.y;
  const double start = column_wise ? a.y : a.x, end = column_wise ? b.y : b.x;
  const double slope_a = slope(a.direction) * span, slope_b = slope(b.direction) * span;
  for (int k = 1; k < steps; ++k) {
    const double u = static_cast<double>(k) / steps, v = 1 - u;
    const double along = from + u * span;
    const double across =
        v * v * (1 + 2 * u) * start + u * u * (1 + 2 * v) * end + u * v * (v * slope_a - u * slope_b);
    RidgePlace p;
    p.x = column_wise ? along : across;
    p.y = column_wise ? across : along;
    p.direction = blended(a.direction, b.direction, u);
    p.strength = v * a.strength + u * b.strength;
    out.push_back(to_stripe_point(p));
  }
}

}  // namespace lightstripe
