// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/direction_guided_ridge.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

constexpr double kCloseEnough =
    0.1;  // px; Steger's t is off by t^3 / (s^2 + sigma^2), below 0.0005 px from here
constexpr int kNewtonSteps = 4;

struct Ridge {
  Direction direction;
  double normal_x = 0, normal_y = 0;
  double curvature = 0;
  RidgeClarity clarity = RidgeClarity::kClear;
};

/// Standard deviation of a curvature where the one across the line is `across`.
double noise_of(const RidgeLimits& limits, double across, bool grain_counts) {
  return grain_counts && limits.grain > 0 ? std::hypot(limits.strength_noise, limits.grain * across)
                                          : limits.strength_noise;
}

/// On the ridge of a single line the curvature along it vanishes.
bool is_single_line(const HessianAxes& axes, const RidgeLimits& limits, bool grain_counts) {
  return axes.across < 0 &&
         std::abs(axes.along) <= -0.15 * axes.across + 2.5 * noise_of(limits, axes.across, grain_counts);
}

/// The surface's own direction where one line alone makes it, else the predicted one.
std::optional<Ridge> ridge_at(const Derivatives& d, const RidgeSearch& search, const RidgeLimits& limits) {
  const HessianAxes axes = hessian_axes(d);
  const Direction& predicted = search.direction;
  if (is_single_line(axes, limits, search.grain_counts)) {
    Ridge r{{-axes.normal_y, axes.normal_x}, axes.normal_x, axes.normal_y, axes.across, RidgeClarity::kClear};
    if (r.direction.dot(predicted) < 0) r.direction = {-r.direction.x, -r.direction.y};
    if (r.direction.dot(predicted) < search.least_cosine) return std::nullopt;
    return r;
  }
  if (search.clear_only) return std::nullopt;
  Ridge r{predicted, -predicted.y, predicted.x, 0, RidgeClarity::kKept};
  r.curvature = second_derivative(d, r.normal_x, r.normal_y);
  // A line at angle a to the predicted direction has a mixed derivative of a times its curvature.
  const double mixed = d.dxx * r.normal_x * predicted.x + d.dyy * r.normal_y * predicted.y +
                       d.dxy * (r.normal_x * predicted.y + r.normal_y * predicted.x);
  if (std::abs(mixed) > -0.12 * r.curvature + 2.0 * noise_of(limits, r.curvature, true))
    r.clarity = RidgeClarity::kDisturbed;
  return r;
}

}  // namespace

Direction blended(const Direction& a, const Direction& b, double weight_b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double scale = length_correction(dx * dx + dy * dy, weight_b);
  return {scale * (a.x + weight_b * dx), scale * (a.y + weight_b * dy)};
}

StripePoint to_stripe_point(const RidgePlace& place) {
  StripePoint p;
  p.x = place.x;
  p.y = place.y;
  p.normal_x = -place.direction.y;
  p.normal_y = place.direction.x;
  p.strength = place.strength;
  return p;
}

template <class T>
std::optional<RidgePlace> RidgeFinder<T>::find(const RidgeSearch& search) const {
  double x = search.x, y = search.y;
  const bool column_wise = search.direction.column_wise();
  for (int step = 0; step < kNewtonSteps; ++step) {
    if (x < -0.5 || y < -0.5 || x > image.width - 0.5 || y > image.height - 0.5) return std::nullopt;
    const PhasedPosition px = to_phase(x), py = to_phase(y);
    const Derivatives d =
        evaluate_derivatives(image, px, py, kernels, search.direction.x, search.direction.y, border_window);
    const auto ridge = ridge_at(d, search, limits);
    if (!ridge) return std::nullopt;
    // The stripe's own grey level, undone what smoothing at its scale takes from a Gaussian's top.
    const double level = d.value - 0.828 * kernels.sigma * kernels.sigma * ridge->curvature;
    const double least =
        std::max(search.least_strength, level < limits.level_low ? limits.shaded_strength : 0.0);
    if (-ridge->curvature < least) return std::nullopt;
    const double t = ridge_offset(d, ridge->normal_x, ridge->normal_y, ridge->curvature);
    // The ridge is met again in this column (or row): points stay evenly spaced.
    const double across = column_wise ? ridge->normal_y : ridge->normal_x;
    if (std::abs(across) < 0.3) return std::nullopt;
    const double move = t / across;
    x = px.value() + (column_wise ? 0.0 : move);
    y = py.value() + (column_wise ? move : 0.0);
    const double distance = column_wise ? y - search.y : x - search.x;
    if (!(std::abs(distance) <= search.reach)) return std::nullopt;
    if (std::abs(t) <= kCloseEnough)
      return RidgePlace{x, y, ridge->direction, -ridge->curvature, ridge->clarity};
  }
  return std::nullopt;
}

template <class T>
std::optional<RidgePlace> RidgeFinder<T>::first_point(int seed_x, int seed_y) const {
  double x = seed_x, y = seed_y;
  const double longest = 4.0 * kernels.sigma;
  for (int step = 0; step < 8; ++step) {
    const Derivatives d = evaluate_derivatives(image, to_phase(x), to_phase(y), kernels, 0, 0, border_window);
    const HessianAxes axes = hessian_axes(d);
    if (!is_single_line(axes, limits, true) || -axes.across < 0.5 * limits.start_strength)
      return std::nullopt;
    const double t =
        std::clamp(ridge_offset(d, axes.normal_x, axes.normal_y, axes.across), -kernels.sigma, kernels.sigma);
    x = to_phase(x).value() + t * axes.normal_x;
    y = to_phase(y).value() + t * axes.normal_y;
    if ((x - seed_x) * (x - seed_x) + (y - seed_y) * (y - seed_y) > longest * longest || x < 0 || y < 0 ||
        x > image.width - 1 || y > image.height - 1)
      return std::nullopt;
    if (std::abs(t) > 0.5) continue;
    RidgeSearch search;
    search.direction = {-axes.normal_y, axes.normal_x};
    const bool column_wise = search.direction.column_wise();
    // Onto the grid of whole columns (rows), along the line.
    const double along =
        column_wise ? (std::round(x) - x) / search.direction.x : (std::round(y) - y) / search.direction.y;
    search.x = column_wise ? std::round(x) : x + along * search.direction.x;
    search.y = column_wise ? y + along * search.direction.y : std::round(y);
    search.least_strength = limits.start_strength;
    search.clear_only = true;
    return find(search);
  }
  return std::nullopt;
}

template struct RidgeFinder<std::uint8_t>;
template struct RidgeFinder<std::uint16_t>;

}  // namespace lightstripe
