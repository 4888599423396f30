// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/correct_circles.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

namespace lightstripe {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d disc_bias_px(const Camera& camera, const Rigid3& cam_from_board, const Vector2d& middle,
                      double diameter_mm) {
  // Gauss-Legendre in the squared radius, exact for polynomials of the fifth degree in it.
  constexpr std::array<double, 3> kNodes{0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> kWeights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  constexpr int kAngles = 12;
  const double step = 1e-3 * diameter_mm;
  const auto pixel = [&](const Vector2d& p) {
    return project(camera, cam_from_board * Vector3d(p.x(), p.y(), 0));
  };
  const auto centre = pixel(middle);
  if (!centre) return Vector2d::Zero();
  Vector2d sum = Vector2d::Zero();
  double area = 0;
  for (std::size_t ring = 0; ring < kNodes.size(); ++ring) {
    const double radius = 0.5 * diameter_mm * std::sqrt(kNodes[ring]);
    for (int k = 0; k < kAngles; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAngles;
      const Vector2d p = middle + radius * Vector2d(std::cos(angle), std::sin(angle));
      const auto here = pixel(p), right = pixel(p + step * Vector2d::UnitX()),
                 below = pixel(p + step * Vector2d::UnitY());
      if (!here || !right || !below) return Vector2d::Zero();
      Eigen::Matrix2d J;
      J << *right - *here, *below - *here;
      const double weight = kWeights[ring] * std::abs(J.determinant());
      sum += weight * (*here - *centre);
      area += weight;
    }
  }
  return sum / area;
}

void correct_circles(InitialValues& values) {
  const Target& target = values.session.target;
  for (std::size_t v = 0; v < values.session.views.size(); ++v) {
    auto& view = values.session.views[v];
    const Camera& camera = values.state.sensors[static_cast<std::size_t>(view.sensor)].camera;
    for (int i = 0; i < target.num_corners(); ++i) {
      auto& corner = view.corners[static_cast<std::size_t>(i)];
      if (is_seen(corner))
        corner -= disc_bias_px(camera, values.cam_from_board[v], target.corner(i), target.circle_mm);
    }
  }
}

}  // namespace lightstripe
