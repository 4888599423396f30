// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/straight_lines.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/linear_algebra.h"
#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMinEdgePoints = 20, kMaxLines = 6;
constexpr double kTolerancePx = 1.2;  // a lens bends a line of some hundred pixels by less
constexpr int kEdgeTrials = 300;

struct StraightLine {
  Vector2d point, normal;
  double distance(const StripePoint& p) const { return std::abs(normal.dot(Vector2d(p.x, p.y) - point)); }
};

StraightLine fitted(const std::vector<StripePoint>& points, const std::vector<std::size_t>& chosen) {
  Vector2d mean = Vector2d::Zero();
  for (const auto i : chosen) mean += Vector2d(points[i].x, points[i].y) / static_cast<double>(chosen.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto i : chosen) {
    const Vector2d d = Vector2d(points[i].x, points[i].y) - mean;
    scatter += d * d.transpose();
  }
  return {mean, symmetric_eigen(scatter).vectors.col(0)};
}

std::vector<std::size_t> within(const std::vector<StripePoint>& points, const StraightLine& line) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (line.distance(points[i]) < kTolerancePx) chosen.push_back(i);
  return chosen;
}

/// The line with the most points (fixed random numbers).
std::vector<std::size_t> best_line(const std::vector<StripePoint>& points) {
  std::vector<std::size_t> best;
  Random random(points.size());
  for (int trial = 0; trial < kEdgeTrials; ++trial) {
    const auto a = static_cast<std::size_t>(random.uniform() * static_cast<double>(points.size()));
    const auto b = static_cast<std::size_t>(random.uniform() * static_cast<double>(points.size()));
    const Vector2d step(points[b].x - points[a].x, points[b].y - points[a].y);
    if (step.norm() < 10) continue;
    const Vector2d along = step.normalized();
    auto chosen = within(points, {{points[a].x, points[a].y}, {-along.y(), along.x()}});
    if (chosen.size() > best.size()) best = std::move(chosen);
  }
  for (int i = 0; i < 2 && best.size() >= kMinEdgePoints; ++i) best = within(points, fitted(points, best));
  return best;
}

}  // namespace

std::vector<std::vector<StripePoint>> straight_lines(const std::vector<Stripe>& stripes) {
  std::vector<StripePoint> points;
  for (const auto& stripe : stripes)
    for (const auto& point : stripe.points)
      if (!(point.flags & kStripeBridged)) points.push_back(point);
  std::vector<std::vector<StripePoint>> lines;
  while (points.size() >= kMinEdgePoints && lines.size() < kMaxLines) {
    const auto chosen = best_line(points);
    if (chosen.size() < kMinEdgePoints) break;
    std::vector<StripePoint> line, rest;
    for (std::size_t i = 0, next = 0; i < points.size(); ++i) {
      const bool taken = next < chosen.size() && chosen[next] == i;
      next += taken;
      (taken ? line : rest).push_back(points[i]);
    }
    lines.push_back(std::move(line));
    points = std::move(rest);
  }
  return lines;
}

}  // namespace lightstripe
