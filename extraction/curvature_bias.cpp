// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/curvature_bias.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

struct LocalShape {
  double curvature_x = 0, curvature_y = 0;  ///< vector to the centre of curvature, 1 / px
  double sigma = 0;                         ///< its 1-sigma error
};

constexpr std::size_t kStride = 2;  // neighbouring points say nearly the same

/// Least-squares parabola through the points i - reach * kStride ... i + reach * kStride, by the point's
/// number.
LocalShape fit_parabola(const std::vector<StripePoint>& points, std::size_t i, std::size_t reach,
                        double kernel_sigma) {
  const auto l = static_cast<double>(reach);
  const double n = 2 * l + 1, s2 = n * l * (l + 1) / 3, s4 = s2 * (3 * l * l + 3 * l - 1) / 5;
  const double mean_square = s2 / n, norm = s4 - n * mean_square * mean_square;
  const StripePoint& centre = points[i];
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  for (std::size_t k = 1; k <= reach; ++k) {
    const StripePoint &a = points[i - k * kStride], &b = points[i + k * kStride];
    const auto u = static_cast<double>(k);
    x1 += u * (b.x - a.x);
    y1 += u * (b.y - a.y);
    // The parabola's regressor u^2 - mean has sum 0, so that the centre may be subtracted.
    x2 += (u * u - mean_square) * (a.x + b.x - 2 * centre.x);
    y2 += (u * u - mean_square) * (a.y + b.y - 2 * centre.y);
  }
  const double tx = x1 / s2, ty = y1 / s2, bx = 2 * x2 / norm, by = 2 * y2 / norm, speed2 = tx * tx + ty * ty;
  const double along = (bx * tx + by * ty) / speed2;
  LocalShape shape;
  shape.curvature_x = (bx - along * tx) / speed2;
  shape.curvature_y = (by - along * ty) / speed2;
  // Neighbouring points share their noise over 2 sqrt(pi) sigma.
  const double shared = std::max(1.0, 3.545 * kernel_sigma / std::sqrt(speed2));
  shape.sigma = 2 * centre.sigma_px * std::sqrt(shared / norm) / speed2;
  return shape;
}

/// For each point of the range how many points before it join without a gap or a bridge.
void count_joined(const std::vector<StripePoint>& points, const LineRange& r, std::vector<float>& joined) {
  for (std::size_t i = r.begin; i < r.end; ++i) {
    joined[i] = 0;
    if (i == r.begin || ((points[i].flags | points[i - 1].flags) & kStripeBridged) != 0) continue;
    const double dx = points[i].x - points[i - 1].x, dy = points[i].y - points[i - 1].y;
    if (dx * dx + dy * dy < 4.0) joined[i] = joined[i - 1] + 1;
  }
}

}  // namespace

void correct_curvature_bias(const DerivativeKernels& kernels, LineSet& lines,
                            std::vector<StripePoint>& scratch, std::vector<float>& joined) {
  const auto most = static_cast<std::size_t>(std::lround((3.0 * kernels.sigma + 2) / kStride));
  constexpr std::size_t kLeast = 3;
  const double half_variance = 0.5 * (kernels.sigma * kernels.sigma + 1.0 / 12);
  scratch.assign(lines.points.begin(), lines.points.end());
  joined.resize(scratch.size());
  for (const LineRange& r : lines.lines) {
    count_joined(scratch, r, joined);
    for (std::size_t i = r.begin; i < r.end; ++i) {
      // As far as both sides join: the last point of the window has to count all of it.
      std::size_t reach = std::min({most, (i - r.begin) / kStride, (r.end - 1 - i) / kStride});
      while (reach >= kLeast && joined[i + reach * kStride] < static_cast<float>(2 * reach * kStride))
        --reach;
      if (reach < kLeast) continue;
      const LocalShape shape = fit_parabola(scratch, i, reach, kernels.sigma);
      const double square = shape.curvature_x * shape.curvature_x + shape.curvature_y * shape.curvature_y;
      const double weight = square / (square + 9 * shape.sigma * shape.sigma);
      // A bend sharper than the kernel is a corner, where the series behind the formula ends.
      const double size = half_variance * std::sqrt(square), limit = 0.25 * kernels.sigma;
      const double shift = weight * half_variance * (size > limit ? limit / size : 1.0);
      lines.points[i].x -= shift * shape.curvature_x;
      lines.points[i].y -= shift * shape.curvature_y;
    }
  }
}

}  // namespace lightstripe
