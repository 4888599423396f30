// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/line_point.h"

#include <cmath>

namespace lightstripe {

HessianAxes hessian_axes(const Derivatives& d) {
  const double mean = 0.5 * (static_cast<double>(d.dxx) + d.dyy);
  const double half = 0.5 * (static_cast<double>(d.dxx) - d.dyy);
  const double spread = std::sqrt(half * half + static_cast<double>(d.dxy) * d.dxy);
  HessianAxes axes;
  // The larger magnitude lies on the side of the mean's sign.
  axes.across = mean > 0 ? mean + spread : mean - spread;
  axes.along = mean > 0 ? mean - spread : mean + spread;
  if (spread == 0) return axes;
  // Of the two equivalent forms of the eigenvector the one without cancellation.
  const double signed_spread = mean > 0 ? spread : -spread;
  double x = d.dxy, y = signed_spread - half;
  if (half * signed_spread > 0) {
    x = signed_spread + half;
    y = d.dxy;
  }
  const double length = std::sqrt(x * x + y * y);
  axes.normal_x = x / length;
  axes.normal_y = y / length;
  return axes;
}

}  // namespace lightstripe
