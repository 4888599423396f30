// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/sheet_thickness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightstripe {

std::optional<double> sheet_sigma_mm(const Camera& camera, const Plane& plane,
                                     const Eigen::Vector3d& p_camera, double width_px) {
  constexpr double kLeastSlant = 0.1;  // sine of the angle between view and normal
  const double along = plane.normal.dot(p_camera.normalized());
  const double seen = std::sqrt(std::max(0.0, 1 - along * along));  // of 1 mm along the normal
  if (seen < kLeastSlant || p_camera.z() <= 0) return std::nullopt;
  // A pixel's own 0.29, and a lens whose contrast at the pixels' limit (half a period a pixel) is 0.3: 0.49.
  constexpr double kBlurPx = 0.57;
  const double line_px = width_px / (2 * std::numbers::sqrt3);
  const double sigma_px = std::sqrt(std::max(0.0, line_px * line_px - kBlurPx * kBlurPx));
  return sigma_px * p_camera.norm() / (0.5 * (camera.fx + camera.fy)) / seen;
}

double sheet_error_mm(double sheet_sigma_mm, double diameter_mm, const Eigen::Vector3d& axis,
                      const Eigen::Vector3d& normal) {
  constexpr double kBall = 8;
  const double along = axis.dot(normal);
  const double curvature = 2 / diameter_mm * (axis.isZero() ? 1 : 1 - along * along);
  return kBall * sheet_sigma_mm * sheet_sigma_mm * curvature;
}

}  // namespace lightstripe
