// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/stripe_crossing.h"

#include <Eigen/Geometry>

#include "calib/adjust/rig_state.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The point of a line nearest to a ray through the origin.
Vector3d nearest_to_ray(const StripeLine& line, const Vector3d& ray) {
  const Vector3d r = ray.normalized();
  const double along = r.dot(line.direction), denominator = 1 - along * along;
  if (denominator < 1e-12) return line.point;
  // Minimise |point + s direction - t r| over s and t.
  const double s = (along * r.dot(line.point) - line.direction.dot(line.point)) / denominator;
  return line.point + s * line.direction;
}

}  // namespace

std::optional<StripeCrossing> stripe_crossing(const Camera& camera, const Plane& board, const Plane& laser,
                                              const Vector2d& pixel) {
  const auto line = stripe_line(board, laser);
  const auto ray = unproject(camera, pixel);
  if (!line || !ray) return std::nullopt;
  const Vector3d nearest = nearest_to_ray(*line, *ray);
  const double step_mm = 1e-3 * nearest.norm();
  const auto seen = project(camera, nearest);
  const auto before = project(camera, nearest - step_mm * line->direction);
  const auto after = project(camera, nearest + step_mm * line->direction);
  if (!seen || !before || !after || !((*after - *before).norm() > 1e-9)) return std::nullopt;
  const Vector2d tangent = (*after - *before).normalized();
  StripeCrossing frame;
  frame.normal = {-tangent.y(), tangent.x()};
  frame.distance_px = frame.normal.dot(*seen - pixel);
  const auto left = unproject(camera, pixel - frame.normal), right = unproject(camera, pixel + frame.normal);
  if (!left || !right) return std::nullopt;
  frame.across = left->cross(*right).normalized();
  return frame;
}

}  // namespace lightstripe
