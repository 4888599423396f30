// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/plane.h"
#include "core/linear_algebra.h"

#include <cmath>

#include "core/error.h"

namespace lightstripe {

Plane canonical(const Plane& plane) {
  const double length = plane.normal.norm();
  LIGHTSTRIPE_CHECK(length > 0, "a plane's normal must not be zero");
  const double scale = (plane.offset < 0 ? -1.0 : 1.0) / length;
  return {plane.normal * scale, plane.offset * scale};
}

Plane transformed(const Plane& plane_b, const Eigen::Matrix3d& rotation_a_from_b,
                  const Eigen::Vector3d& translation_a_from_b) {
  const Eigen::Vector3d normal = rotation_a_from_b * plane_b.normal;
  return canonical({normal, plane_b.offset + normal.dot(translation_a_from_b)});
}

std::optional<Eigen::Vector3d> intersect(const Plane& plane, const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction) {
  constexpr double kParallel = 1e-9;  // sine of the angle below which the meeting point means nothing
  const double towards = plane.normal.dot(direction);
  if (std::abs(towards) < kParallel * direction.norm()) return std::nullopt;
  const double s = (plane.offset - plane.normal.dot(origin)) / towards;
  if (!(s > 0)) return std::nullopt;
  return origin + s * direction;
}

bool PlaneFit::determined() const {
  return spread.y() > 0 && spread.y() > 1e-6 * spread.x() && spread.z() < 0.5 * spread.y();
}

PlaneFit fit_plane(std::span<const Eigen::Vector3d> points) {
  LIGHTSTRIPE_CHECK(points.size() >= 3, "a plane needs three points");
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : points) scatter += (p - mean) * (p - mean).transpose();
  scatter /= static_cast<double>(points.size());
  const SymmetricEigen eigen = symmetric_eigen(scatter);
  PlaneFit fit;
  fit.spread = eigen.values.cwiseMax(0.0).cwiseSqrt().reverse();
  const Eigen::Vector3d normal = eigen.vectors.col(0);
  fit.plane = canonical({normal, normal.dot(mean)});
  fit.rms = fit.spread.z();
  return fit;
}

}  // namespace lightstripe
