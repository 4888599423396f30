// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/robust.h"

namespace lightstripe {
namespace {

/// Strength, as a share of that further in, from which on a point of a square end is as good as any.
constexpr double kWhole = 0.9;
/// 1-sigma shift of the centre at an end, px: a stripe cut off at 45 degrees is off by this where half the
/// strength is left, a square end by 0.15 px.
constexpr double kEndShift = 1.2;
/// In sigma; an oblique cut of 45 degrees draws the end of its line 0.8 sigma aside.
constexpr double kObliqueReach = 1.25;

/// One line seen from one of its ends.
struct EndView {
  std::span<StripePoint> points;
  bool from_back;

  std::size_t size() const { return points.size(); }
  StripePoint& operator[](std::size_t i) const { return points[from_back ? points.size() - 1 - i : i]; }
};

struct Continuation {
  double x = 0, y = 0;                ///< px
  double normal_x = 0, normal_y = 0;  ///< unit, on the side of the points' own normals
  double sigma = 0;                   ///< px
};

/// What is known of a line further in than an end disturbs it.
struct Inside {
  std::span<const LocalFitPoint> places;  ///< from the end on
  double sigma_px = 0;                    ///< of each
  double shared = 1;                      ///< points that share their noise
  std::size_t narrow = 0, wide = 0;       ///< reaches of the two parabolas
};

/// The parabolas through the points from `first_good` on, read at `i` before them. The wider one is the
/// surer, as long as the line is one: what both disagree by is added to its error.
Continuation continue_line(const Inside& inside, std::size_t i, std::size_t first_good,
                           const StripePoint& at) {
  LocalFitter fitter(inside.places);
  LocalFitPoint near, far;
  Continuation c;
  for (const bool wide : {false, true}) {
    const std::size_t reach = wide ? inside.wide : inside.narrow;
    const LocalFit fit = fitter.at(first_good + reach, reach);
    const double offset = static_cast<double>(i) - static_cast<double>(first_good + reach);
    (wide ? far : near) = {fit.x + offset * (fit.slope_x + 0.5 * offset * fit.second_x),
                           fit.y + offset * (fit.slope_y + 0.5 * offset * fit.second_y)};
    const double tangent_x = fit.slope_x + offset * fit.second_x,
                 tangent_y = fit.slope_y + offset * fit.second_y;
    const double sign = tangent_x * at.normal_y - tangent_y * at.normal_x > 0 ? 1.0 : -1.0;
    const double scale = sign / std::max(std::hypot(tangent_x, tangent_y), 1e-9);
    c = {far.x, far.y, -tangent_y * scale, tangent_x * scale,
         inside.sigma_px * std::sqrt(inside.shared * local_fit_variance(reach, offset))};
  }
  const double disagreement = (near.x - far.x) * c.normal_x + (near.y - far.y) * c.normal_y;
  c.sigma = std::hypot(c.sigma, 0.5 * disagreement);
  return c;
}

/// From a point to the continuation, along its normal, px.
double distance_across(const Continuation& c, const StripePoint& p) {
  return (c.x - p.x) * c.normal_x + (c.y - p.y) * c.normal_y;
}

double median_strength(const EndView& end, std::size_t first, std::size_t count) {
  double strengths[24];
  const std::size_t step = 1 + count / 24;
  std::size_t used = 0;
  for (std::size_t i = first; i < first + count && used < 24; i += step) strengths[used++] = end[i].strength;
  return upper_median(std::span(strengths, used));
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

void mend_end(const EndView& end, double sigma, double shared_px, std::vector<LocalFitPoint>& places) {
  const auto scale = static_cast<std::size_t>(std::ceil(sigma));
  const std::size_t narrow = 2 * scale, wide = 4 * scale, most = 3 * scale, retreat = 3 * scale;
  if (end.size() < most + retreat + 2 * wide + 2) return;
  const double reference = median_strength(end, most, most);
  const auto whole = first_whole_point(end, kWhole * reference, most);
  const std::size_t needed = whole.value_or(0) + retreat + 2 * wide + 1;
  if (!whole || *whole == 0 || !is_joined(end, needed)) return;
  places.clear();
  for (std::size_t i = 0; i < needed; ++i) places.push_back({end[i].x, end[i].y});
  const double dx = places[1].x - places[0].x, dy = places[1].y - places[0].y;
  const double shared = std::max(1.0, shared_px / std::max(std::hypot(dx, dy), 0.5));
  const Inside inside{places, end[*whole + narrow].sigma_px, shared, narrow, wide};
  // An oblique cut draws the line aside before its strength falls: there the points further in do not lead to
  // it.
  const Continuation test = continue_line(inside, *whole, *whole + retreat, end[*whole]);
  const double unexpected = std::abs(distance_across(test, end[*whole]));
  // It draws it less than kObliqueReach aside; farther off the line bends.
  const Continuation last = continue_line(inside, 0, *whole + retreat, end[0]);
  const bool oblique = unexpected > 0.05 && unexpected > 3 * std::hypot(test.sigma, end[*whole].sigma_px) &&
                       std::abs(distance_across(last, end[0])) < kObliqueReach * sigma;
  const std::size_t first_good = oblique ? *whole + retreat : *whole;
  for (std::size_t i = 0; i < first_good; ++i) {
    StripePoint& p = end[i];
    const Continuation c = continue_line(inside, i, first_good, p);
    const double lost =
        oblique ? 1 - static_cast<double>(i) / static_cast<double>(first_good) : 1 - p.strength / reference;
    const double sigma_measured = std::hypot(p.sigma_px, kEndShift * lost * lost);
    const double a = 1 / (sigma_measured * sigma_measured), b = 1 / (c.sigma * c.sigma);
    const double across = distance_across(c, p) * b / (a + b);
    p.x += across * c.normal_x;
    p.y += across * c.normal_y;
    p.sigma_px = 1 / std::sqrt(a + b);
    if (!oblique) continue;
    p.normal_x = c.normal_x;
    p.normal_y = c.normal_y;
  }
}

}  // namespace

void mend_line_ends(const DerivativeKernels& kernels, LineSet& lines, std::vector<LocalFitPoint>& places) {
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    mend_end({line, false}, kernels.sigma, r.shared_px, places);
    mend_end({line, true}, kernels.sigma, r.shared_px, places);
  }
}

}  // namespace lightstripe
