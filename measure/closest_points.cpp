// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/closest_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/linear_algebra.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kArmMm = 100;  // makes a turn comparable with a shift

bool allowed(const ZoneMask& mask, Zone zone) { return mask[static_cast<std::size_t>(zone)]; }

}  // namespace

std::vector<FitPoint> find_counterparts(const Section& section, const SectionPose& pose,
                                        const ReferenceShape& reference, int step) {
  std::vector<FitPoint> out;
  out.reserve(section.size() / static_cast<std::size_t>(step) + 1);
  const Eigen::Rotation2Dd turn(pose.move.angle_rad);
  const Eigen::Matrix2d R = turn.toRotationMatrix();
  for (std::size_t i = static_cast<std::size_t>(step / 2); i < section.size();
       i += static_cast<std::size_t>(step)) {
    Vector2d p = section[i].position;
    if (pose.mirrored) p.x() = -p.x();
    p = R * p + pose.move.translation;
    const auto foot = reference.nearest(p);
    if (!foot || foot->beyond_end) continue;
    out.push_back({p, foot->normal, foot->signed_distance, 0, reference.zone(*foot), section[i].weight,
                   static_cast<int>(i)});
  }
  return out;
}

void weigh(std::vector<FitPoint>& points, const ZoneMask& mask, double floor_mm, double cap_mm) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const FitPoint& point : points)
    if (allowed(mask, point.zone)) distances.push_back(std::abs(point.residual));
  if (distances.empty()) return;
  const double scale =
      std::clamp(kMadToSigma * median(std::move(distances)), floor_mm, std::max(floor_mm, cap_mm));
  for (FitPoint& point : points)
    point.weight = allowed(mask, point.zone) ? point.prior * tukey_weight(point.residual / scale) : 0.0;
}

NormalEquations normal_equations(const std::vector<FitPoint>& points) {
  NormalEquations sum;
  for (const FitPoint& point : points) {
    if (point.weight <= 0) continue;
    const Vector2d &p = point.position, &n = point.normal;
    const Vector3d J(p.x() * n.y() - p.y() * n.x(), n.x(), n.y());
    sum.H += point.weight * J * J.transpose();
    sum.g += point.weight * point.residual * J;
    sum.weight += point.weight;
    sum.squares += point.weight * point.residual * point.residual;
  }
  return sum;
}

double apply_step(const NormalEquations& equations, bool upright, SectionPose& pose) {
  constexpr double kHeld =
      1e-7;  // share of the largest eigenvalue below which the points do not hold a direction
  const Vector3d units(1 / kArmMm, 1, 1);
  Eigen::Matrix3d H = units.asDiagonal() * equations.H * units.asDiagonal();
  Vector3d g = units.asDiagonal() * equations.g;
  if (upright) {
    H.row(0).setZero(), H.col(0).setZero();
    g(0) = 0;
  }
  const SymmetricEigen eigen = symmetric_eigen(H);
  Vector3d change = Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    if (eigen.values(i) > kHeld * eigen.values(2) && eigen.values(i) > 0)
      change -= eigen.vectors.col(i) * (eigen.vectors.col(i).dot(g) / eigen.values(i));
  const double angle = change(0) / kArmMm;
  pose.move.translation = Eigen::Rotation2Dd(angle) * pose.move.translation + change.tail<2>();
  pose.move.angle_rad += angle;
  return change.norm();
}

}  // namespace lightstripe
