// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/board_spread.h"

#include <algorithm>
#include <cmath>

#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d pixel_of(const SessionViews& session, const Residual& m) {
  const auto& point = session.views[m.view].stripes[static_cast<std::size_t>(m.plane)][m.index];
  return {point.x, point.y};
}

double tilt_spread_deg(const SessionViews& session, const RigState& state, int sensor) {
  std::vector<Vector3d> normals;
  Vector3d mean = Vector3d::Zero();
  for (const auto& view : session.views) {
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

std::vector<double> laser_angles_deg(const SessionViews& session, const RigState& state, int sensor,
                                     std::size_t plane) {
  const auto& of = state.sensors[static_cast<std::size_t>(sensor)];
  std::vector<double> angles;
  for (const auto& view : session.views) {
    if (view.sensor != sensor || view.pose < 0 || view.stripes[plane].empty()) continue;
    const Rigid3 cam_from_board =
        of.cam_from_first * state.first_from_board[static_cast<std::size_t>(view.pose)];
    const Vector3d normal = cam_from_board.rotation * Vector3d::UnitZ();
    angles.push_back(std::asin(std::min(1.0, normal.cross(of.laser_planes[plane].normal).norm())) / kDegree);
  }
  return angles;
}

DepthRange stripe_depths(const SessionViews& session, const RigState& state,
                         const std::vector<Residual>& residuals, int sensor) {
  DepthRange range;
  const auto& of = state.sensors[static_cast<std::size_t>(sensor)];
  for (const auto& m : residuals) {
    if (m.is_corner() || !m.used || session.views[m.view].sensor != sensor) continue;
    const auto ray = unproject(of.camera, pixel_of(session, m));
    const auto p = ray ? intersect(of.laser_planes[static_cast<std::size_t>(m.plane)], Vector3d::Zero(), *ray)
                       : std::nullopt;
    if (!p) continue;
    range.near_mm = range.near_mm == 0 ? p->z() : std::min(range.near_mm, p->z());
    range.far_mm = std::max(range.far_mm, p->z());
  }
  return range;
}

double stripe_coverage(const SessionViews& session, const std::vector<Residual>& residuals, int sensor) {
  Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const auto& m : residuals) {
    if (m.is_corner() || !m.used || session.views[m.view].sensor != sensor) continue;
    low = low.cwiseMin(pixel_of(session, m));
    high = high.cwiseMax(pixel_of(session, m));
  }
  const auto& size = session.image_sizes[static_cast<std::size_t>(sensor)];
  return (high - low).norm() / std::hypot(size[0], size[1]);
}

}  // namespace

BoardSpread board_spread(const SessionViews& session, const JointAdjustment& adjustment, int sensor) {
  BoardSpread spread;
  spread.tilt_deg = tilt_spread_deg(session, adjustment.state, sensor);
  const auto& planes = adjustment.state.sensors[static_cast<std::size_t>(sensor)].laser_planes;
  for (std::size_t p = 0; p < planes.size(); ++p)
    spread.laser_angles_deg.push_back(laser_angles_deg(session, adjustment.state, sensor, p));
  spread.stripe_depths = stripe_depths(session, adjustment.state, adjustment.residuals, sensor);
  spread.stripe_coverage = stripe_coverage(session, adjustment.residuals, sensor);
  return spread;
}

std::vector<BoardSpread> board_spreads(const SessionViews& session, const JointAdjustment& adjustment) {
  std::vector<BoardSpread> spreads;
  for (std::size_t s = 0; s < session.sensor_names.size(); ++s)
    spreads.push_back(board_spread(session, adjustment, static_cast<int>(s)));
  return spreads;
}

}  // namespace lightstripe
