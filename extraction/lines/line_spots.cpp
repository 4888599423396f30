// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "extraction/lines/line_measure.h"
#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

constexpr double kWider = 1.5;                            // than the line: a spot, where it is clipped
constexpr double kClippedLine = 0.5;                      // share of a line; beyond it the line itself is
constexpr double kOfUniform = 0.5 / std::numbers::sqrt3;  // standard deviation of what lies anywhere in 1

bool is_white(const StripePoint& p) { return (p.flags & kStripeSaturated) != 0; }

/// Median width of a line's points that are not clipped; 0 where too many are.
double own_width(std::span<const StripePoint> points, std::size_t stride, std::vector<float>& values) {
  values.clear();
  std::size_t looked_at = 0;
  for (std::size_t i = 0; i < points.size(); i += stride, ++looked_at)
    if (!is_white(points[i])) values.push_back(static_cast<float>(points[i].width));
  const auto clipped = static_cast<double>(looked_at - values.size());
  return clipped < kClippedLine * static_cast<double>(looked_at) ? double{ranked_median(values)} : 0.0;
}

}  // namespace

void find_binning_errors(double sigma, int bin, LineSet& lines) {
  // Of a coarse pixel: Gaussian stripes of 3.5 to 12 px, clipped 1.5 to 60 times, in pixels of 2 to 16, have
  // errors of 0.001 to 0.018 rms along the pixels, whatever their noise; a quarter where they cross them.
  constexpr double kOfBin = 0.006, kCrossing = 0.25;
  if (bin == 1) return;
  lines.systematic.resize(lines.points.size(), 0.0F);
  for (std::size_t i = 0; i < lines.points.size(); ++i) {
    const StripePoint& p = lines.points[i];
    if (!is_white(p)) continue;
    const double x = std::abs(p.normal_x), y = std::abs(p.normal_y);
    // The kernels average over places within the pixels that the line runs through.
    const double cycles = std::min(x, y) / std::max(x, y) * sigma / bin,
                 left = std::exp(-0.5 * std::pow(2 * std::numbers::pi * cycles, 2));
    const double error = kOfBin * bin * std::max(kCrossing, left);
    lines.systematic[i] = std::hypot(lines.systematic[i], static_cast<float>(error));
  }
}

void find_spot_errors(LineSet& lines, std::vector<float>& values) {
  lines.systematic.resize(lines.points.size(), 0.0F);
  for (const LineRange& r : lines.lines) {
    const std::span<const StripePoint> points(lines.points.data() + r.begin, r.size());
    if (std::none_of(points.begin(), points.end(), is_white)) continue;
    const double width = own_width(points, sample_step(r), values);
    if (width == 0) continue;
    const auto is_wide = [&](const StripePoint& p) { return p.width > kWider * width; };
    for (auto at = points.begin(); at != points.end();) {
      const auto first = std::find_if(at, points.end(), is_wide);
      at = std::find_if_not(first, points.end(), is_wide);
      if (std::none_of(first, at, is_white)) continue;
      for (auto p = first; p != at; ++p) {
        float& error = lines.systematic[r.begin + static_cast<std::size_t>(p - points.begin())];
        error = std::hypot(error, static_cast<float>(kOfUniform * (p->width - width)));
      }
    }
  }
}

}  // namespace lightstripe
