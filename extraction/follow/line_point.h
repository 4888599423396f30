// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Is there a line at this place? Steger 1998, section 2.3, and what noise does to the answer.
#pragma once

#include <cmath>
#include "extraction/kernels/kernels.h"

namespace lightstripe {

/// The principal directions of the image surface.
struct HessianAxes {
  double normal_x = 1, normal_y = 0;  ///< unit eigenvector of the eigenvalue of largest magnitude
  double across = 0;                  ///< that eigenvalue, grey levels / px^2; negative on a bright line
  double along = 0;                   ///< the other one
};
inline HessianAxes hessian_axes(const Derivatives& d) {
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

/// Second derivative in the direction (nx, ny), |n| = 1.
inline double second_derivative(const Derivatives& d, double nx, double ny) {
  return d.dxx * nx * nx + 2.0 * d.dxy * nx * ny + d.dyy * ny * ny;
}

/// Steger's t: signed distance along n to where the first derivative vanishes, px. `curvature` must not be 0.
inline double ridge_offset(const Derivatives& d, double nx, double ny, double curvature) {
  return -(d.dx * nx + d.dy * ny) / curvature;
}

/// Predicted 1-sigma error of the centre across the line, px, for pixel noise of `noise` grey levels at the
/// flanks: the noise of the first derivative over the second one. With sigma = s and peak A this is 0.564
/// noise / A.
inline double centre_sigma(const DerivativeKernels& kernels, double noise, double strength) {
  return noise * kernels.gradient_gain / strength;
}

}  // namespace lightstripe
