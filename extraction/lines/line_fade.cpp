// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_fade.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/robust.h"

namespace lightstripe {
namespace {

/// Tangent of the angle between a line's normal and the lines of equal brightness, 1 sigma. Shading by the
/// surface's own bend runs across a stripe only where the camera looks along its sheet.
constexpr double kObliqueness = 0.5;
/// Slopes up to so many times the line's median are its grain, which the scatter of its rows counts.
constexpr float kGrain = 2;

void find_in_line(std::span<const StripePoint> points, double sigma, std::span<float> errors,
                  std::vector<float>& values) {
  const auto reach = static_cast<std::size_t>(std::ceil(sigma));
  if (points.size() < 4 * reach) return;
  values.assign(points.size(), 0.0F);
  for (std::size_t i = reach; i + reach < points.size(); ++i) {
    const double before = points[i - reach].strength, behind = points[i + reach].strength;
    // Twice the difference over the sum: the logarithm's slope, which stays finite.
    values[i] = static_cast<float>(std::abs(behind - before) /
                                   (std::max(behind + before, 1e-9) * static_cast<double>(reach)));
  }
  const std::span inner = std::span(values).subspan(reach, points.size() - 2 * reach);
  std::copy(inner.begin(), inner.end(), errors.begin() + static_cast<std::ptrdiff_t>(reach));
  const float usual = kGrain * upper_median(inner);
  for (std::size_t i = reach; i + reach < points.size(); ++i) {
    const float slope = errors[i];
    const double square = points[i].width * points[i].width / 12;  // width = 2 sqrt(3) s
    errors[i] = slope <= usual ? 0.0F
                               : static_cast<float>(kObliqueness * std::min(square, sigma * sigma)) *
                                     std::sqrt(slope * slope - usual * usual);
  }
}

}  // namespace

void find_fade_errors(const DerivativeKernels& kernels, LineSet& lines, std::vector<float>& values) {
  lines.systematic.assign(lines.points.size(), 0.0F);
  for (const LineRange& r : lines.lines)
    find_in_line(std::span(lines.points.data() + r.begin, r.size()), kernels.sigma,
                 std::span(lines.systematic.data() + r.begin, r.size()), values);
}

void add_systematic_errors(LineSet& lines) {
  if (lines.systematic.size() != lines.points.size()) return;  // not known
  for (const LineRange& r : lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const double error{lines.systematic[i]};
      if (error > 0.1 * lines.points[i].sigma_px)
        lines.points[i].sigma_px =
            std::sqrt(lines.points[i].sigma_px * lines.points[i].sigma_px + error * error);
    }
}

}  // namespace lightstripe
