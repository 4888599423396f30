// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_fade.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

/// Tangent of the angle between a line's normal and the lines of equal brightness, 1 sigma. Shading by the
/// surface's own bend runs across a stripe only where the camera looks along its sheet.
constexpr double kObliqueness = 0.5;
/// Slopes up to so many times the line's median are its grain, which the scatter of its rows counts.
constexpr float kGrain = 4;

/// Twice the difference of the strengths around each point over their sum and distance: the slope of the
/// logarithm, which stays finite.
void find_slopes(std::span<const StripePoint> points, std::size_t reach, std::vector<float>& slopes) {
  slopes.assign(points.size(), 0.0F);
  for (std::size_t i = reach; i + reach < points.size(); ++i) {
    const double before = points[i - reach].strength, behind = points[i + reach].strength;
    slopes[i] = static_cast<float>(std::abs(behind - before) /
                                   (std::max(behind + before, 1e-9) * static_cast<double>(reach)));
  }
}

/// The median of every fourth slope; `scratch` is overwritten.
float usual_slope(std::span<const float> slopes, std::size_t reach, std::span<float> scratch) {
  constexpr std::size_t kStride = 4;
  std::size_t count = 0;
  for (std::size_t i = reach; i + reach < slopes.size(); i += kStride) scratch[count++] = slopes[i];
  return ranked_median(scratch.first(count));
}

void find_in_line(std::span<const StripePoint> points, double sigma, std::span<float> errors,
                  std::vector<float>& slopes) {
  const auto reach = static_cast<std::size_t>(std::ceil(sigma));
  if (points.size() < 4 * reach) return;
  find_slopes(points, reach, slopes);
  const float usual = kGrain * usual_slope(slopes, reach, errors);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // A stain moves the ridge up to two sigma before it is seen in the strength.
    float slope = slopes[i];
    for (const std::size_t away : {reach, 2 * reach}) {
      if (i >= away) slope = std::max(slope, slopes[i - away]);
      if (i + away < slopes.size()) slope = std::max(slope, slopes[i + away]);
    }
    errors[i] = 0;
    if (slope <= usual) continue;
    const double square = points[i].width * points[i].width / 12;  // width = 2 sqrt(3) s
    const auto gain = static_cast<float>(kObliqueness * std::min(square, sigma * sigma));
    errors[i] = gain * std::sqrt(slope * slope - usual * usual);
  }
}

}  // namespace

void find_fade_errors(const DerivativeKernels& kernels, LineSet& lines, std::vector<float>& values) {
  lines.fading.assign(lines.points.size(), 0.0F);
  for (const LineRange& r : lines.lines)
    find_in_line(std::span(lines.points.data() + r.begin, r.size()), kernels.sigma,
                 std::span(lines.fading.data() + r.begin, r.size()), values);
}

}  // namespace lightstripe
