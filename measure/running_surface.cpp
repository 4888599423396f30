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

/// Unit, to the left of the passage.
Vector2d normal_of(const std::vector<Vector2d>& curve, std::size_t i) {
  const Vector2d along = (curve[std::min(i + 1, curve.size() - 1)] - curve[i > 0 ? i - 1 : 0]).normalized();
  return {-along.y(), along.x()};
}

/// The noise of a profile's points.
struct PointNoise {
  double sigma_mm = 0, correlation_mm = 0;
};

/// Residuals + 2 sigma^2 (parameters spent on noise), Mallows' Cp.
double mallows(const std::vector<Vector2d>& points, const std::vector<double>& arc,
               const std::vector<double>& strengths, const PointNoise& noise) {
  const std::vector<Vector2d> curve = smoothed(points, SmoothingSpline(arc, strengths));
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) squares += (points[i] - curve[i]).squaredNorm();
  const double spent = noise.correlation_mm > 0 ? spent_on_shared_errors(arc, strengths, noise.correlation_mm)
                                                : spent_parameters(arc, strengths);
  return squares + 2 * noise.sigma_mm * noise.sigma_mm * spent;
}

constexpr double kSoftest = 1e-9, kStiffest = 1e5;  // mm^5; a wave of 30 mm passes the stiffest by half
constexpr double kFactorStep = 3;

std::vector<double> scaled(const std::vector<double>& shape, double factor) {
  std::vector<double> out;
  for (const double one : shape) out.push_back(std::clamp(factor * one, kSoftest, kStiffest));
  return out;
}

/// The strengths' factor between two that Mallows' criterion likes best.
double best_factor(const std::vector<Vector2d>& points, const std::vector<double>& arc,
                   const std::vector<double>& shape, const PointNoise& noise, double from, double to) {
  double best = from, best_cost = 1e300;
  for (double factor = from; factor <= to * 1.01; factor *= kFactorStep)
    if (const double cost = mallows(points, arc, scaled(shape, factor), noise); cost < best_cost)
      best_cost = cost, best = factor;
  return best;
}

/// How stiff the spline may be at each point, for a factor: 1 over the mean square of the curve's third
/// derivative within some mm.
std::vector<double> stiffness(const std::vector<Vector2d>& points, const std::vector<double>& arc) {
  constexpr double kWindowMm = 3, kPilot = 1e4;  // the pilot passes waves of 20 mm by half
  constexpr double kLeast = 1e-8;                // mm^-4: curvature that changes by 1e-4 per mm a mm
  const std::vector<Vector2d> pilot =
      smoothed(points, SmoothingSpline(arc, std::vector<double>(arc.size(), kPilot)));
  const std::vector<double> y = coordinates(pilot, 0), z = coordinates(pilot, 1);
  std::vector<double> sums{0};
  for (std::size_t i = 0; i < arc.size(); ++i) {
    const std::size_t at = std::min(i > 0 ? i - 1 : 0, arc.size() - 4);
    sums.push_back(sums.back() + std::pow(third_derivative_of(arc, y, at), 2) +
                   std::pow(third_derivative_of(arc, z, at), 2));
  }
  std::vector<double> out;
  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < arc.size(); ++i) {
    while (arc[i] - arc[from] > kWindowMm) ++from;
    while (to < arc.size() && arc[to] - arc[i] <= kWindowMm) ++to;
    out.push_back(1 / (kLeast + (sums[to] - sums[from]) / static_cast<double>(to - from)));
  }
  const double softest = *std::min_element(out.begin(), out.end());
  for (double& one : out) one /= softest;
  return out;
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
  out.curve_ = points;
  std::vector<double> strengths;
  // The second round measures the arc on the smooth curve: noise lengthens the first one.
  for (int round = 0; round < 2; ++round) {
    out.arc_mm_ = arc_lengths(out.curve_);
    const std::vector<double> shape = stiffness(points, out.arc_mm_);
    out.factor_ =
        best_factor(points, out.arc_mm_, shape, {sigma, options.correlation_mm}, kSoftest, kStiffest);
    strengths = scaled(shape, out.factor_);
    out.curve_ = smoothed(points, SmoothingSpline(out.arc_mm_, strengths));
  }
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    squares += std::pow((points[i] - out.curve_[i]).dot(normal_of(out.curve_, i)), 2);
  const double spent = spent_parameters(out.arc_mm_, strengths);
  const auto n = static_cast<double>(points.size());
  out.sigma_mm_ = options.sigma_mm.value_or(std::sqrt(squares / std::max(1.0, n - spent)));
  const std::vector<std::size_t> nodes = ascending(out.curve_);
  LIGHTSTRIPE_CHECK(nodes.size() >= 4, "a surface has at least four points");
  out.table_ = tabulate(out.curve_, nodes, options.step_mm);
  return out;
}

HeightTable RunningSurface::redrawn(Random& random) const {
  constexpr double kAbout = 27;  // of the factor, either way
  if (!(sigma_mm_ > 0) || curve_.empty()) return table_;
  std::vector<Vector2d> points = curve_;
  double last = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double kept =
        i == 0 || correlation_mm_ <= 0 ? 0.0 : std::exp(-(arc_mm_[i] - arc_mm_[i - 1]) / correlation_mm_);
    last = kept * last + std::sqrt(1 - kept * kept) * sigma_mm_ * random.gaussian();
    points[i] += last * normal_of(curve_, i);
  }
  const std::vector<double> shape = stiffness(points, arc_mm_);
  const double factor = best_factor(points, arc_mm_, shape, {sigma_mm_, correlation_mm_}, factor_ / kAbout,
                                    std::min(kStiffest, factor_ * kAbout));
  const std::vector<Vector2d> curve = smoothed(points, SmoothingSpline(arc_mm_, scaled(shape, factor)));
  HeightTable drawn = tabulate(curve, ascending(curve), table_.step_mm);
  return drawn.height_mm.size() < 8 ? table_ : drawn;
}

}  // namespace lightstripe
