// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// Distance to the nearest edge of the squares; their outer edges count.
double to_square_edge(double value, double pitch, int corners) {
  const double line = std::clamp(std::round(value / pitch), -1.0, static_cast<double>(corners));
  return std::abs(value - line * pitch);
}

/// Distance to the nearest edge of a tag or of the black squares between tags.
double to_tag_edge(double value, const Target& target, int corners) {
  const double step = target.marker_mm + target.tag_gap_mm;
  double nearest = std::numeric_limits<double>::infinity();
  const double first = std::floor(value / step);
  for (int i = -1; i <= 1; ++i) {
    const double begin = std::clamp(first + i, -1.0, std::floor(0.5 * corners)) * step;
    nearest = std::min({nearest, std::abs(value - begin), std::abs(value - begin - target.marker_mm)});
  }
  return nearest;
}

/// How far a coordinate lies beyond the print; 0 on it.
double beyond(double value, double extent, double border) {
  return std::max({0.0, -border - value, value - extent - border});
}

std::array<PrintEdge, 2> straight_edges(const Target& target, const Vector2d& p) {
  const auto distance = [&](double value, double pitch, int corners) {
    return target.type == TargetType::kAprilgrid ? to_tag_edge(value, target, corners)
                                                 : to_square_edge(value, pitch, corners);
  };
  const double x = distance(p.x(), target.pitch_x, target.columns);
  const double y = distance(p.y(), target.pitch_y, target.rows);
  // On the rim the lines of the other direction have ended.
  const double beyond_x = beyond(p.x(), target.extent().x(), target.border().x());
  const double beyond_y = beyond(p.y(), target.extent().y(), target.border().y());
  return {{{std::hypot(x, beyond_y), Vector2d::UnitX()}, {std::hypot(y, beyond_x), Vector2d::UnitY()}}};
}

PrintEdge circle_edge(const Target& target, const Vector2d& p) {
  PrintEdge nearest{std::numeric_limits<double>::infinity(), Vector2d::UnitX()};
  for (int i = 0; i < target.num_corners(); ++i) {
    const Vector2d from_middle = p - target.corner(i);
    const double distance = std::abs(from_middle.norm() - 0.5 * target.circle_mm);
    if (distance < nearest.distance_mm && from_middle.norm() > 0)
      nearest = {distance, from_middle.normalized()};
  }
  return nearest;
}

bool in_marker(const Target& target, const Vector2d& p) {
  if (target.type == TargetType::kCharuco) {
    const auto column = static_cast<long>(std::floor(p.x() / target.pitch_x)),
               row = static_cast<long>(std::floor(p.y() / target.pitch_y));
    return (column + row) % 2 != 0;  // the markers are in the light squares
  }
  if (target.type != TargetType::kAprilgrid) return false;
  const double step = target.marker_mm + target.tag_gap_mm;
  const Vector2d in_step = p - step * (p / step).array().floor().matrix();
  return in_step.maxCoeff() < target.marker_mm;
}

}  // namespace

std::array<PrintEdge, 2> nearest_edges(const Target& target, const Vector2d& p) {
  if (!target.has_circles()) return straight_edges(target, p);
  const PrintEdge edge = circle_edge(target, p);
  return {{edge, edge}};
}

bool on_rim(const Target& target, const Vector2d& p) {
  return beyond(p.x(), target.extent().x(), target.border().x()) > 0 ||
         beyond(p.y(), target.extent().y(), target.border().y()) > 0;
}

bool carries_stripes(const Target& target, const Vector2d& p) {
  const Vector2d outside(beyond(p.x(), target.extent().x(), target.border().x()),
                         beyond(p.y(), target.extent().y(), target.border().y()));
  if (outside.maxCoeff() >= std::max(target.rim(), 1e-9)) return false;
  return outside.maxCoeff() > 0 || !in_marker(target, p);
}

}  // namespace lightstripe
