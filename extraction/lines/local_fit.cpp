// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/local_fit.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

/// Sums of 1, k^2 and k^4 over k = -reach ... reach.
struct Powers {
  double n, s2, s4;
  explicit Powers(std::size_t reach) {
    const auto l = static_cast<double>(reach);
    n = 2 * l + 1;
    s2 = n * l * (l + 1) / 3;
    s4 = s2 * (3 * l * l + 3 * l - 1) / 5;
  }
  /// Of the quadratic term's normal equation, the constant eliminated.
  double norm() const { return s4 - s2 * s2 / n; }
};

}  // namespace

LocalFitGains local_fit_gains(std::size_t reach) {
  const Powers p(reach);
  return {std::sqrt(p.s4 / (p.n * p.s4 - p.s2 * p.s2)), 2 / std::sqrt(p.norm())};
}

double local_fit_variance(std::size_t reach, double offset) {
  const Powers p(reach);
  const double square = offset * offset, determinant = p.n * p.s4 - p.s2 * p.s2;
  return (p.s4 - 2 * square * p.s2 + square * square * p.n) / determinant + square / p.s2;
}

void LocalFitter::start(std::size_t i, std::size_t reach) {
  if (reach != reach_) {
    const Powers p(reach);
    f_ = {p.s2 / p.n, 1 / p.norm(), 1 / p.n, 1 / p.s2};
  }
  x_ = y_ = {};
  origin_x_ = points_[i].x;
  origin_y_ = points_[i].y;
  for (std::size_t m = 0; m <= 2 * reach; ++m) {
    const LocalFitPoint& p = points_[i - reach + m];
    const double k = static_cast<double>(m) - static_cast<double>(reach);
    x_.add(k, p.x - origin_x_);
    y_.add(k, p.y - origin_y_);
  }
  slides_ = 0;
}

void LocalFitter::slide_to(std::size_t i) {
  const auto l = static_cast<double>(reach_);
  for (; last_ < i; ++last_, ++slides_) {
    const LocalFitPoint &left = points_[last_ - reach_], &right = points_[last_ + 1 + reach_];
    x_.slide(left.x - origin_x_, right.x - origin_x_, l);
    y_.slide(left.y - origin_y_, right.y - origin_y_, l);
  }
}

LocalFit LocalFitter::at(std::size_t i, std::size_t reach) {
  constexpr std::size_t kFreshAfter = 64;  // slides, before rounding errors or a far origin could count
  if (reach == reach_ && i >= last_ && i - last_ < reach && slides_ < kFreshAfter) {
    slide_to(i);
  } else {
    start(i, reach);
    last_ = i;
    reach_ = reach;
  }
  const double qx = (x_.s2 - f_.mean_square * x_.s0) * f_.scale,
               qy = (y_.s2 - f_.mean_square * y_.s0) * f_.scale;
  LocalFit fit;
  fit.x = origin_x_ + x_.s0 * f_.inverse_n - qx * f_.mean_square;
  fit.y = origin_y_ + y_.s0 * f_.inverse_n - qy * f_.mean_square;
  fit.slope_x = x_.s1 * f_.inverse_s2;
  fit.slope_y = y_.s1 * f_.inverse_s2;
  fit.squared_step = fit.slope_x * fit.slope_x + fit.slope_y * fit.slope_y;
  fit.second_x = 2 * qx;
  fit.second_y = 2 * qy;
  const double inverse = 1 / std::max(fit.squared_step, 1e-12);
  const double along = 2 * (qx * fit.slope_x + qy * fit.slope_y) * inverse;
  fit.curvature_x = (2 * qx - along * fit.slope_x) * inverse;
  fit.curvature_y = (2 * qy - along * fit.slope_y) * inverse;
  return fit;
}

std::size_t joined_end(std::span<const StripePoint> points, std::size_t begin) {
  std::size_t end = begin + 1;
  for (; end < points.size(); ++end) {
    if (((points[end].flags | points[end - 1].flags) & kStripeBridged) != 0) break;
    const double dx = points[end].x - points[end - 1].x, dy = points[end].y - points[end - 1].y;
    if (dx * dx + dy * dy >= 4.0) break;
  }
  return end;
}

}  // namespace lightstripe
