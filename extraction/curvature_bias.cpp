// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/curvature_bias.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "extraction/local_fit.h"

namespace lightstripe {
namespace {

using Shift = BendWorkspace::Shift;

/// The way from one smoothed point to the true line.
class BiasEstimate {
 public:
  BiasEstimate(double sigma, std::span<const StripePoint> points)
      : sigma_(sigma), half_variance_(0.5 * (sigma * sigma + 1.0 / 12)), points_(points), fitter_(points) {}

  Shift at(std::size_t i, std::size_t reach) {
    const LocalFit fit = fitter_.at(i, reach);
    if (reach != reach_) gain_ = local_fit_gains(reach_ = reach).curvature;
    // Neighbouring points share their noise over 2 sqrt(pi) sigma.
    const double shared = std::max(1.0, 3.545 * sigma_ / std::sqrt(fit.squared_step));
    const double sigma_px = points_[i].sigma_px;
    const double variance =
        sigma_px * sigma_px * gain_ * gain_ * shared / (fit.squared_step * fit.squared_step);
    const double square = fit.curvature_x * fit.curvature_x + fit.curvature_y * fit.curvature_y;
    if (square <= 0) return {};
    const double weight = square / (square + 9 * variance);
    // A bend sharper than the kernel is a corner, where the series behind the formula ends.
    const double size = half_variance_ * std::sqrt(square), limit = 0.25 * sigma_;
    const double shift = weight * half_variance_ * (size > limit ? limit / size : 1.0);
    return {-shift * fit.curvature_x, -shift * fit.curvature_y};
  }

 private:
  double sigma_, half_variance_;
  std::span<const StripePoint> points_;
  LocalFitter fitter_;
  std::size_t reach_ = 0;
  double gain_ = 0;
};

}  // namespace

void correct_curvature_bias(const DerivativeKernels& kernels, LineSet& lines, BendWorkspace& w) {
  const auto most = static_cast<std::size_t>(std::lround(3.0 * kernels.sigma + 2));
  // The bend of a line that was smoothed over sigma changes little within one.
  const auto stride = static_cast<std::size_t>(std::max(1.0, kernels.sigma));
  constexpr std::size_t kLeast = 6;
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> points(lines.points.data() + r.begin, r.size());
    count_joined(points, w.joined);
    w.shifts.assign(points.size(), {});
    BiasEstimate bias(kernels.sigma, points);
    Shift shift;
    std::size_t valid_until = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t reach = joined_reach(w.joined, i, most);
      if (reach < kLeast) {
        valid_until = 0;
        continue;
      }
      if (i >= valid_until || reach != most) {
        // One estimate serves `stride` points, from their middle.
        const std::size_t middle = i + stride / 2;
        const bool central =
            reach == most && middle < points.size() && joined_reach(w.joined, middle, most) == most;
        shift = bias.at(central ? middle : i, reach);
        valid_until = i + stride;
      }
      w.shifts[i] = shift;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].x += w.shifts[i].x;
      points[i].y += w.shifts[i].y;
    }
  }
}

}  // namespace lightstripe
