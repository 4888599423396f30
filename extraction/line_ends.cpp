// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/line_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace lightstripe {
namespace {

/// Strength, as a share of that further in, from which on a point is as good as any.
constexpr double kWhole = 0.9;
/// Shift of the centre at an end of strength share s: this times (1 - s)^2 px, 1 sigma. A stripe cut off at
/// 45 degrees is off by 0.5 px where half the strength is left, a square end by 0.15 px.
constexpr double kEndShift = 1.2;

/// One line seen from one of its ends.
struct EndView {
  std::span<StripePoint> points;
  bool from_back;

  std::size_t size() const { return points.size(); }
  StripePoint& operator[](std::size_t i) const { return points[from_back ? points.size() - 1 - i : i]; }
};

struct Continuation {
  double x = 0, y = 0;  ///< px
  double sigma = 0;     ///< px
};

/// A parabola through 2 reach + 1 points from `first_good` on, read at `i` before them. `places`: the line
/// from its end.
Continuation continue_line(std::span<const FitPoint> places, std::size_t i, std::size_t first_good,
                           std::size_t reach, double sigma_px, double shared) {
  LocalFitter fitter(places);
  const LocalFit fit = fitter.at(first_good + reach, reach);
  const double offset = static_cast<double>(i) - static_cast<double>(first_good + reach);
  return {fit.x + offset * (fit.slope_x + 0.5 * offset * fit.second_x),
          fit.y + offset * (fit.slope_y + 0.5 * offset * fit.second_y),
          sigma_px * std::sqrt(shared * local_fit_variance(reach, offset))};
}

double median_strength(const EndView& end, std::size_t first, std::size_t count) {
  double strengths[24];
  const std::size_t step = 1 + count / 24;
  std::size_t used = 0;
  for (std::size_t i = first; i < first + count && used < 24; i += step) strengths[used++] = end[i].strength;
  std::nth_element(strengths, strengths + used / 2, strengths + used);
  return strengths[used / 2];
}

/// The first point from the end on that is as strong as those further in; nothing where that takes more than
/// an end does.
std::optional<std::size_t> first_whole_point(const EndView& end, double whole, std::size_t most) {
  for (std::size_t i = 0; i <= most; ++i)
    if (end[i].strength >= whole) return i;
  return std::nullopt;
}

bool is_joined(const EndView& end, std::size_t count) {
  const std::span<StripePoint> stretch = end.from_back ? end.points.last(count) : end.points.first(count);
  return joined_end(stretch, 0) == count;
}

void mend_end(const EndView& end, double sigma, std::vector<FitPoint>& places) {
  const auto scale = static_cast<std::size_t>(std::ceil(sigma));
  const std::size_t narrow = 2 * scale, wide = 4 * scale, most = 3 * scale;
  if (end.size() < most + 2 * wide + 2) return;
  const double reference = median_strength(end, most, most);
  const auto good = first_whole_point(end, kWhole * reference, most);
  if (!good || *good == 0 || !is_joined(end, *good + 2 * wide + 1)) return;
  places.clear();
  for (std::size_t i = 0; i < *good + 2 * wide + 1; ++i) places.push_back({end[i].x, end[i].y});
  const StripePoint& inner = end[*good + narrow];
  const double dx = places[*good + 1].x - places[*good].x, dy = places[*good + 1].y - places[*good].y;
  const double shared = std::max(1.0, 3.545 * sigma / std::max(std::hypot(dx, dy), 0.5));
  for (std::size_t i = 0; i < *good; ++i) {
    StripePoint& p = end[i];
    const Continuation near = continue_line(places, i, *good, narrow, inner.sigma_px, shared);
    const Continuation far = continue_line(places, i, *good, wide, inner.sigma_px, shared);
    // The wider parabola is the surer one, as long as the line is one.
    const double disagreement = (near.x - far.x) * p.normal_x + (near.y - far.y) * p.normal_y;
    const double sigma_continued = std::hypot(far.sigma, 0.5 * disagreement);
    const double lost = 1 - p.strength / reference,
                 sigma_measured = std::hypot(p.sigma_px, kEndShift * lost * lost);
    const double a = 1 / (sigma_measured * sigma_measured), b = 1 / (sigma_continued * sigma_continued);
    const double across = ((far.x - p.x) * p.normal_x + (far.y - p.y) * p.normal_y) * b / (a + b);
    p.x += across * p.normal_x;
    p.y += across * p.normal_y;
    p.sigma_px = 1 / std::sqrt(a + b);
  }
}

}  // namespace

void mend_line_ends(const DerivativeKernels& kernels, LineSet& lines, std::vector<FitPoint>& places) {
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    mend_end({line, false}, kernels.sigma, places);
    mend_end({line, true}, kernels.sigma, places);
  }
}

}  // namespace lightstripe
