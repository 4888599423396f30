// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/laser_lines.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "reconstruct/laser_assignment.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinAlignment = 0.866;  // cosine: lines farther than 30 degrees from the mean have no order

/// Mean of a stripe's points in normalised coordinates, distortion left on: it does not change the order.
Vector2d mean_position(const Stripe& stripe, const Camera& camera) {
  Vector2d sum = Vector2d::Zero();
  for (const auto& p : stripe.points)
    sum += Vector2d((p.x - camera.cx) / camera.fx, (p.y - camera.cy) / camera.fy);
  return sum / static_cast<double>(stripe.points.size());
}

/// The unit direction in which the planes' lines follow each other: the mean of their (n_x, n_y), signs made
/// equal.
std::optional<Vector2d> direction_across(const std::vector<Plane>& planes) {
  Vector2d sum = Vector2d::Zero();
  for (const Plane& plane : planes) {
    const Vector2d g = plane.normal.head<2>();
    sum += g.dot(sum) < 0 ? Vector2d(-g) : g;
  }
  const double length = sum.norm();
  for (const Plane& plane : planes) {
    const Vector2d g = plane.normal.head<2>();
    if (!(std::abs(g.dot(sum)) > kMinAlignment * length * g.norm())) return std::nullopt;
  }
  return Vector2d(sum / length);
}

/// Where a plane's line lies in the picture, along `across` from the ray (x, y, 1), on a surface at depth z:
/// slope / z + start, from n.X = d.
struct LinePosition {
  double slope = 0, start = 0;

  double at(double inverse_depth) const { return slope * inverse_depth + start; }
};

LinePosition line_position(const Plane& plane, const Vector2d& across, const Vector2d& centre) {
  const double along = plane.normal.head<2>().dot(across);
  return {plane.offset / along, -plane.normal.dot(Vector3d(centre.x(), centre.y(), 1)) / along};
}

std::vector<double> positions_at(const std::vector<LinePosition>& lines, double inverse_depth) {
  std::vector<double> positions;
  positions.reserve(lines.size());
  for (const LinePosition& line : lines) positions.push_back(line.at(inverse_depth));
  return positions;
}

std::vector<int> sorted_indices(const std::vector<double>& values) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return values[static_cast<std::size_t>(a)] < values[static_cast<std::size_t>(b)];
  });
  return order;
}

/// The planes in order at the depth that explains the stripes best (sum of squares over the ordered pairs).
/// Tried are the depths at which one plane lies exactly on one stripe. Empty where no depth > 0 does.
std::vector<int> plane_order(const std::vector<LinePosition>& lines,
                             const std::vector<double>& sorted_stripes) {
  std::vector<int> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const LinePosition& line : lines) {
    for (const double stripe : sorted_stripes) {
      const double inverse_depth = (stripe - line.start) / line.slope;
      if (!(inverse_depth > 0)) continue;
      const auto positions = positions_at(lines, inverse_depth);
      const auto order = sorted_indices(positions);
      double cost = 0;
      for (std::size_t i = 0; i < order.size(); ++i) {
        const double off = positions[static_cast<std::size_t>(order[i])] - sorted_stripes[i];
        cost += off * off;
      }
      if (cost < best_cost) best_cost = cost, best = order;
    }
  }
  return best;
}

/// As many stripes as planes, paired in order; empty where that says nothing.
std::vector<int> paired_in_order(const std::vector<Stripe>& stripes, const Sensor& sensor) {
  const auto& planes = sensor.laser_planes;
  const bool has_empty =
      std::any_of(stripes.begin(), stripes.end(), [](const Stripe& s) { return s.points.empty(); });
  if (planes.empty() || stripes.size() != planes.size() || has_empty) return {};
  const auto across = direction_across(planes);
  if (!across) return {};

  Vector2d centre = Vector2d::Zero();
  for (const Stripe& s : stripes)
    centre += mean_position(s, sensor.camera) / static_cast<double>(stripes.size());
  std::vector<double> positions;
  positions.reserve(stripes.size());
  for (const Stripe& s : stripes) positions.push_back(across->dot(mean_position(s, sensor.camera) - centre));
  std::vector<LinePosition> lines;
  lines.reserve(planes.size());
  for (const Plane& plane : planes) lines.push_back(line_position(plane, *across, centre));

  const std::vector<int> stripe_order = sorted_indices(positions);
  std::sort(positions.begin(), positions.end());
  const std::vector<int> planes_in_order = plane_order(lines, positions);
  if (planes_in_order.empty()) return {};
  std::vector<int> plane_of_stripe(stripes.size());
  for (std::size_t i = 0; i < stripes.size(); ++i)
    plane_of_stripe[static_cast<std::size_t>(stripe_order[i])] = planes_in_order[i];
  return plane_of_stripe;
}

}  // namespace

std::vector<LineDecision> decide_laser_planes(const std::vector<Stripe>& stripes, const Sensor& sensor) {
  if (sensor.laser_planes.size() == 1) return std::vector<LineDecision>(stripes.size(), {0});
  if (sensor.depth_range_mm[1] > 0) return assign_by_reach(stripes, sensor);
  const std::vector<int> paired = paired_in_order(stripes, sensor);
  std::vector<LineDecision> decisions(stripes.size());
  for (std::size_t i = 0; i < paired.size(); ++i) decisions[i].plane = paired[i];
  return decisions;
}

std::vector<std::optional<int>> assign_laser_planes(const std::vector<Stripe>& stripes,
                                                    const Sensor& sensor) {
  std::vector<std::optional<int>> planes;
  for (const LineDecision& decision : decide_laser_planes(stripes, sensor)) planes.push_back(decision.plane);
  return planes;
}

}  // namespace lightstripe
