// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/running_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "measure/smoothing_spline.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kSameMm = 1e-3;  // points closer together are one

std::vector<double> coordinates(const std::vector<Vector2d>& points, int axis) {
  std::vector<double> out;
  for (const Vector2d& p : points) out.push_back(p(axis));
  return out;
}

std::vector<double> arc_lengths(const std::vector<Vector2d>& points) {
  std::vector<double> out{0};
  for (std::size_t i = 1; i < points.size(); ++i)
    out.push_back(out.back() + std::max(kSameMm, (points[i] - points[i - 1]).norm()));
  return out;
}

std::vector<Vector2d> smoothed(const std::vector<Vector2d>& points, const SmoothingSpline& spline) {
  const std::vector<double> y = spline(coordinates(points, 0)), z = spline(coordinates(points, 1));
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < points.size(); ++i) out.emplace_back(y[i], z[i]);
  return out;
}

/// The strength with the least residuals + 2 sigma^2 (parameters spent), Mallows' Cp.
double best_strength(const std::vector<Vector2d>& points, const std::vector<double>& arc, double sigma) {
  double best = 0, best_cost = 1e300;
  for (double strength = 1e-9; strength < 3e4; strength *= 3) {
    const std::vector<Vector2d> curve = smoothed(points, SmoothingSpline(arc, strength));
    double squares = 0;
    for (std::size_t i = 0; i < points.size(); ++i) squares += (points[i] - curve[i]).squaredNorm();
    const double cost = squares + 2 * sigma * sigma * spent_parameters(arc.back(), points.size(), strength);
    if (cost < best_cost) best_cost = cost, best = strength;
  }
  return best;
}

/// Without points that double another or turn back against y by more than the noise can.
std::vector<Vector2d> distinct(const std::vector<Vector2d>& points) {
  std::vector<Vector2d> out;
  for (const Vector2d& p : points)
    if (out.empty() || (p - out.back()).norm() > kSameMm) out.push_back(p);
  return out;
}

/// Nodes whose y ascends strictly.
std::vector<std::size_t> ascending(const std::vector<Vector2d>& curve) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (out.empty() || curve[i].x() > curve[out.back()].x() + kSameMm) out.push_back(i);
  return out;
}

/// The cubic through four points at `at`.
double lagrange(const std::array<Vector2d, 4>& p, double at) {
  double sum = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    double weight = p[a].y();
    for (std::size_t b = 0; b < 4; ++b)
      if (b != a) weight *= (at - p[b].x()) / (p[a].x() - p[b].x());
    sum += weight;
  }
  return sum;
}

/// Height of a curve, whose y ascends at `nodes`, by cubics.
HeightTable tabulate(const std::vector<Vector2d>& curve, const std::vector<std::size_t>& nodes, double step) {
  HeightTable table;
  table.step_mm = step;
  table.first_mm = std::ceil(curve[nodes.front()].x() / step) * step;
  const double last = curve[nodes.back()].x();
  std::size_t at = 1;
  for (double y = table.first_mm; y <= last + 1e-9;
       y = table.first_mm + step * static_cast<double>(table.height_mm.size())) {
    while (at + 1 < nodes.size() && curve[nodes[at]].x() < y) ++at;
    const std::size_t from = std::min(at >= 2 ? at - 2 : 0, nodes.size() - 4);
    table.height_mm.push_back(lagrange(
        {curve[nodes[from]], curve[nodes[from + 1]], curve[nodes[from + 2]], curve[nodes[from + 3]]}, y));
  }
  return table;
}

}  // namespace

double HeightTable::at(double y) const {
  const double place = (y - first_mm) / step_mm;
  const auto last = static_cast<double>(height_mm.size()) - 3;
  const double cell = std::clamp(std::floor(place), 1.0, last);
  const double t = place - cell;
  const double* const h = height_mm.data() + static_cast<std::ptrdiff_t>(cell);
  // Newton's form of the cubic through the nodes at -1, 0, 1, 2.
  const double second = h[1] - 2 * h[0] + h[-1], third = h[2] - 3 * h[1] + 3 * h[0] - h[-1];
  return h[0] + t * (h[1] - h[0]) + t * (t - 1) / 2 * (second + (t + 1) / 3 * third);
}

double HeightTable::slope_at(double y) const { return (at(y + step_mm) - at(y - step_mm)) / (2 * step_mm); }

RunningSurface RunningSurface::exact(const std::vector<Vector2d>& points, double step_mm) {
  LIGHTSTRIPE_CHECK(points.size() >= 4, "a surface has at least four points");
  RunningSurface out;
  out.table_ = tabulate(points, ascending(points), step_mm);
  return out;
}

RunningSurface RunningSurface::measured(const std::vector<Vector2d>& raw, const SmoothingOptions& options) {
  const std::vector<Vector2d> points = distinct(raw);
  LIGHTSTRIPE_CHECK(points.size() >= 8, "a measured surface has at least eight points");
  RunningSurface out;
  out.correlation_mm_ = options.correlation_mm;
  const double noise =
      std::hypot(difference_noise(coordinates(points, 0)), difference_noise(coordinates(points, 1)));
  const double sigma = options.sigma_mm.value_or(noise);
  std::vector<Vector2d> curve = points;
  // The second round measures the arc on the smooth curve: noise lengthens the first one.
  for (int round = 0; round < 2; ++round) {
    out.arc_mm_ = arc_lengths(curve);
    out.strength_ = best_strength(points, out.arc_mm_, sigma);
    curve = smoothed(points, SmoothingSpline(out.arc_mm_, out.strength_));
  }
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d along =
        (curve[std::min(i + 1, points.size() - 1)] - curve[i > 0 ? i - 1 : 0]).normalized();
    const Vector2d off = points[i] - curve[i];
    squares += std::pow(along.x() * off.y() - along.y() * off.x(), 2);
    out.upright_.push_back(1 / std::max(0.2, std::abs(along.x())));
  }
  const double spent = spent_parameters(out.arc_mm_.back(), points.size(), out.strength_);
  const auto n = static_cast<double>(points.size());
  out.sigma_mm_ = options.sigma_mm.value_or(std::sqrt(squares / std::max(1.0, n - spent)));
  const std::vector<std::size_t> nodes = ascending(curve);
  LIGHTSTRIPE_CHECK(nodes.size() >= 4, "a surface has at least four points");
  out.table_ = tabulate(curve, nodes, options.step_mm);
  std::size_t at = 0;
  for (std::size_t k = 0; k < out.table_.height_mm.size(); ++k) {
    const double y = out.table_.first_mm + out.table_.step_mm * static_cast<double>(k);
    while (at + 2 < nodes.size() && curve[nodes[at + 1]].x() < y) ++at;
    const double from = curve[nodes[at]].x(), to = curve[nodes[at + 1]].x();
    out.before_.push_back(nodes[at]);
    out.share_.push_back(std::clamp((y - from) / (to - from), 0.0, 1.0));
  }
  return out;
}

HeightTable RunningSurface::redrawn(Random& random) const {
  HeightTable out = table_;
  if (!(sigma_mm_ > 0) || arc_mm_.empty()) return out;
  std::vector<double> noise(arc_mm_.size());
  double last = 0;
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const double kept =
        i == 0 || correlation_mm_ <= 0 ? 0.0 : std::exp(-(arc_mm_[i] - arc_mm_[i - 1]) / correlation_mm_);
    last = kept * last + std::sqrt(1 - kept * kept) * sigma_mm_ * random.gaussian();
    noise[i] = last;
  }
  const std::vector<double> left = SmoothingSpline(arc_mm_, strength_)(noise);
  for (std::size_t k = 0; k < out.height_mm.size(); ++k) {
    const std::size_t i = before_[k], next = std::min(i + 1, left.size() - 1);
    out.height_mm[k] += (1 - share_[k]) * left[i] * upright_[i] + share_[k] * left[next] * upright_[next];
  }
  return out;
}

}  // namespace lightstripe
