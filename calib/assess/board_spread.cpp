// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/board_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

Vector2d pixel_of(const SessionViews& measurements, const Residual& m) {
  const auto& point = measurements.views[m.view].stripes[static_cast<std::size_t>(m.plane)][m.index];
  return {point.x, point.y};
}

}  // namespace

double tilt_spread_deg(const SessionViews& measurements, const RigState& state, int sensor) {
  std::vector<Vector3d> normals;
  Vector3d mean = Vector3d::Zero();
  for (const auto& view : measurements.views) {
    if (view.sensor != sensor || view.pose < 0) continue;
    normals.emplace_back(state.first_from_board[static_cast<std::size_t>(view.pose)].rotation *
                         Vector3d::UnitZ());
    mean += normals.back();
  }
  double spread = 0;
  for (const auto& normal : normals)
    spread = std::max(spread, std::acos(std::clamp(normal.dot(mean.normalized()), -1.0, 1.0)));
  return spread / kDegree;
}

std::vector<double> laser_angles_deg(const SessionViews& measurements, const RigState& state, int sensor,
                                     std::size_t plane) {
  const auto& of = state.sensors[static_cast<std::size_t>(sensor)];
  std::vector<double> angles;
  for (const auto& view : measurements.views) {
    if (view.sensor != sensor || view.pose < 0 || view.stripes[plane].empty()) continue;
    const Rigid3 cam_from_board =
        of.cam_from_first * state.first_from_board[static_cast<std::size_t>(view.pose)];
    const Vector3d normal = cam_from_board.rotation * Vector3d::UnitZ();
    angles.push_back(std::asin(std::min(1.0, normal.cross(of.laser_planes[plane].normal).norm())) / kDegree);
  }
  return angles;
}

DepthRange stripe_depths(const SessionViews& measurements, const RigState& state,
                         const std::vector<Residual>& list, int sensor) {
  DepthRange range;
  const auto& of = state.sensors[static_cast<std::size_t>(sensor)];
  for (const auto& m : list) {
    if (m.is_corner() || !m.used || measurements.views[m.view].sensor != sensor) continue;
    const auto ray = unproject(of.camera, pixel_of(measurements, m));
    const auto p = ray ? intersect(of.laser_planes[static_cast<std::size_t>(m.plane)], Vector3d::Zero(), *ray)
                       : std::nullopt;
    if (!p) continue;
    range.near_mm = range.near_mm == 0 ? p->z() : std::min(range.near_mm, p->z());
    range.far_mm = std::max(range.far_mm, p->z());
  }
  return range;
}

double stripe_coverage(const SessionViews& measurements, const std::vector<Residual>& list, int sensor) {
  Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const auto& m : list) {
    if (m.is_corner() || !m.used || measurements.views[m.view].sensor != sensor) continue;
    low = low.cwiseMin(pixel_of(measurements, m));
    high = high.cwiseMax(pixel_of(measurements, m));
  }
  const auto& size = measurements.image_sizes[static_cast<std::size_t>(sensor)];
  return (high - low).norm() / std::hypot(size[0], size[1]);
}

}  // namespace lightstripe
