// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/curvature_bias.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "extraction/local_fit.h"

namespace lightstripe {

void correct_curvature_bias(const DerivativeKernels& kernels, LineSet& lines,
                            std::vector<StripePoint>& scratch, std::vector<float>& joined) {
  const auto most = static_cast<std::size_t>(std::lround(3.0 * kernels.sigma + 2));
  constexpr std::size_t kLeast = 6;
  const double half_variance = 0.5 * (kernels.sigma * kernels.sigma + 1.0 / 12);
  for (const LineRange& r : lines.lines) {
    scratch.assign(lines.points.begin() + static_cast<std::ptrdiff_t>(r.begin),
                   lines.points.begin() + static_cast<std::ptrdiff_t>(r.end));
    count_joined(scratch, joined);
    LocalFitter fitter(scratch);
    std::size_t gain_reach = 0;
    double gain = 0;
    for (std::size_t i = 0; i < scratch.size(); ++i) {
      const std::size_t reach = joined_reach(joined, i, most);
      if (reach < kLeast) continue;
      const LocalFit fit = fitter.at(i, reach);
      // Neighbouring points share their noise over 2 sqrt(pi) sigma.
      const double shared = std::max(1.0, 3.545 * kernels.sigma / std::sqrt(fit.squared_step));
      if (reach != gain_reach) gain = local_fit_gains(gain_reach = reach).curvature;
      const double variance = scratch[i].sigma_px * scratch[i].sigma_px * gain * gain * shared /
                              (fit.squared_step * fit.squared_step);
      const double square = fit.curvature_x * fit.curvature_x + fit.curvature_y * fit.curvature_y;
      const double weight = square / (square + 9 * variance);
      // A bend sharper than the kernel is a corner, where the series behind the formula ends.
      const double size = half_variance * std::sqrt(square), limit = 0.25 * kernels.sigma;
      const double shift = weight * half_variance * (size > limit ? limit / size : 1.0);
      lines.points[r.begin + i].x -= shift * fit.curvature_x;
      lines.points[r.begin + i].y -= shift * fit.curvature_y;
    }
  }
}

}  // namespace lightstripe
