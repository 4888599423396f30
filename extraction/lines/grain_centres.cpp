// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/grain_centres.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/robust.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/ranked_value.h"
#include "extraction/lines/row_crossing.h"

namespace lightstripe {
namespace {

/// Where the noise is this share of c I_0 and more, the weights gain less than a tenth.
constexpr double kMostNoise = 0.25;
/// Light fainter than this is no Gaussian's foot any more, but glow and neighbours.
constexpr double kLeastNoise = 0.05;
constexpr double kLeastStripe = 1.0;  // px: a narrower one has too few pixels across for such weights
constexpr double kSharpRadius = 20;   // sigma: below it a row is no cut across one straight stripe
constexpr double kFarOut = 4;         // standard deviations of the rows' differences
constexpr double kLeastSlope = 0.3;   // of the line's median
constexpr float kNoCentre = std::numeric_limits<float>::quiet_NaN();

/// Sums of one row's pixels by the taps; not usable where the row ends before them.
template <class T>
void sum_row(ImageView<T> image, const GrainWeights& weights, const StripePoint& p,
             GrainWorkspace::Row& row) {
  const RowCrossing c = row_crossing_at(p);
  const int count = c.is_row ? image.width : image.height, rows = c.is_row ? image.height : image.width;
  const double reach = weights.half / (weights.per_px * c.cosine);
  const int first = static_cast<int>(std::ceil(c.centre - reach)),
            last = static_cast<int>(std::floor(c.centre + reach));
  if (c.index < 0 || c.index >= rows || first < 0 || last >= count) return;
  const std::ptrdiff_t step = c.is_row ? 1 : image.stride;
  const T* pixels = (c.is_row ? image.row(c.index) : image.data + c.index);
  // Weights are odd: a background changes nothing but the error of sums in place of integrals.
  const float background =
      0.5F * (static_cast<float>(pixels[first * step]) + static_cast<float>(pixels[last * step]));
  std::array<float, 4> sums{};
  const double scale = weights.per_px * c.cosine, from = weights.half + 0.5 - c.centre * scale;
  for (int i = first; i <= last; ++i) {
    const auto& tap = weights.taps[static_cast<std::size_t>(i * scale + from)];
    const float value = static_cast<float>(pixels[i * step]) - background;
    for (std::size_t k = 0; k < 4; ++k) sums[k] += tap[k] * value;
  }
  const double sign = (c.is_row ? p.normal_x : p.normal_y) < 0 ? -1 : 1;
  row = {.shift = sums[0],
         .slope = sums[1],
         .old_shift = sums[2],
         .old_slope = sums[3],
         .sign = sign,
         .at = c,
         .usable = true};
}

/// Weights of a Gaussian along the line, one side, their whole sum 1.
void make_along(double sigma, std::vector<float>& along) {
  along.assign(static_cast<std::size_t>(3.2 * sigma) + 1, 0);
  double sum = 0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double d = static_cast<double>(i) / sigma;
    along[i] = static_cast<float>(std::exp(-0.5 * d * d));
    sum += (i > 0 ? 2.0 : 1.0) * static_cast<double>(along[i]);
  }
  for (float& weight : along) weight = static_cast<float>(static_cast<double>(weight) / sum);
}

/// Sum of value(row) over the usable rows around one, by their weights.
template <class Value>
double along_line(const GrainWorkspace& w, std::size_t i, const Value& value) {
  double sum = w.rows[i].usable ? static_cast<double>(w.along[0]) * value(w.rows[i]) : 0;
  for (std::size_t d = 1; d < w.along.size(); ++d) {
    double both = 0;
    if (d <= i && w.rows[i - d].usable) both += value(w.rows[i - d]);
    if (i + d < w.rows.size() && w.rows[i + d].usable) both += value(w.rows[i + d]);
    sum += static_cast<double>(w.along[d]) * both;
  }
  return sum;
}

template <class Value>
double median_of_rows(GrainWorkspace& w, const Value& value) {
  w.values.clear();
  for (const auto& row : w.rows)
    if (row.usable) w.values.push_back(static_cast<float>(value(row)));
  return ranked_median(w.values);
}

/// Centres by both kinds of weights. What a shift adds is the line's, not the single row's: a dark row would
/// scatter twice.
void find_centres(GrainWorkspace& w) {
  const double typical = median_of_rows(w, [](const auto&row) { return row.slope; }),
               old_typical = median_of_rows(w, [](const auto&row) { return row.old_slope; });
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    auto& row = w.rows[i];
    if (!row.usable) continue;
    const double share = along_line(w, i, [](const auto&) { return 1.0; });
    const double slope = along_line(w, i, [](const auto&r) { return r.slope; }) / share,
                 old_slope = along_line(w, i, [](const auto&r) { return r.old_slope; }) / share;
    const bool clear = slope > kLeastSlope * typical && old_slope > kLeastSlope * old_typical;
    row.centre = clear ? static_cast<float>(row.sign * row.shift / slope) : kNoCentre;
    row.difference = row.centre - static_cast<float>(row.sign * row.old_shift / old_slope);
  }
  for (auto& row : w.rows) row.usable = row.usable && !std::isnan(row.difference);
  const auto size = [](const auto& row) { return std::abs(static_cast<double>(row.difference)); };
  const double scatter = kMadToSigma * median_of_rows(w, size);
  for (auto& row : w.rows) row.usable = row.usable && size(row) < kFarOut * scatter;
}

/// How far each point moves, and the rows' centres against the moved line. Returns the rows' mean cosine.
double find_moves(GrainWorkspace& w, std::vector<float>& offsets) {
  RowOffsets seen(offsets);
  w.moves.clear();
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const auto& row = w.rows[i];
    w.moves.push_back({along_line(w, i, [](const auto& r) { return static_cast<double>(r.difference); }),
                       along_line(w, i, [](const auto&) { return 1.0; })});
    if (!row.usable || !row.tells_scatter) {
      seen.skip();
      continue;
    }
    if (!seen.has(row.at)) seen.add(row.at, row.centre - static_cast<float>(w.moves.back().across));
  }
  return seen.mean_cosine();
}

/// Whether the rows agree better by the new weights, and no more than by scatter differ from the old: a
/// stripe that is no Gaussian in grain (texture, a neighbour, clipping, glow) stays where the kernels see it.
/// Of the best and another estimate the difference has the variance that one has more than the other.
bool is_better(const RowScatter& before, const RowScatter& after, double sigma, const GrainWorkspace& w) {
  constexpr double kLeastGain = 0.9;
  double squares = 0;
  for (const auto& move : w.moves) squares += move.across * move.across;
  const double variance = before.of_point(sigma);
  return after.of_point(sigma) < kLeastGain * variance &&
         squares < variance * static_cast<double>(w.moves.size());
}

void move_points(const LineRange& range, const GrainWorkspace& w, LineSet& lines) {
  lines.recentred.resize(lines.points.size());
  for (std::size_t i = 0; i < w.moves.size(); ++i) {
    StripePoint& p = lines.points[range.begin + i];
    p.x += w.moves[i].across * p.normal_x;
    p.y += w.moves[i].across * p.normal_y;
    lines.recentred[range.begin + i] = static_cast<float>(w.moves[i].share);
  }
}

double length_of(const LineSet& lines, const LineRange& r) {
  double length = 0;
  for (std::size_t i = r.begin + 1; i < r.end; ++i) {
    const StripePoint &a = lines.points[i - 1], &b = lines.points[i];
    length += std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  return length;
}

}  // namespace

GrainWeights make_grain_weights(double stripe, const DerivativeKernels& kernels, double noise) {
  constexpr double kSteps = 64;  // of the stripe's standard deviation
  GrainWeights weights;
  weights.per_px = kSteps / stripe;
  weights.half = static_cast<int>(3.2 * kernels.sigma * weights.per_px);
  const double s2 = stripe * stripe, k2 = kernels.sigma * kernels.sigma;
  for (int i = -weights.half; i <= weights.half; ++i) {
    const double q = i / weights.per_px, light = std::exp(-0.5 * q * q / s2), g = std::exp(-0.5 * q * q / k2);
    const double variance = light * light + noise * noise, w = light / variance;
    const double slope = w * (1 - q * q / s2) + 2 * w * (light * light / variance) * q * q / s2;
    weights.taps.push_back({static_cast<float>(q * w), static_cast<float>(slope), static_cast<float>(q * g),
                            static_cast<float>(g * (1 - q * q / k2))});
  }
  return weights;
}

std::optional<double> noise_over_grain(const RowScatter& scatter, double stripe, double sigma) {
  if (!(scatter.grain_variance > 0)) return std::nullopt;
  // The kernels' weights q g(q) see noise as the integral of (q g)^2, grain as that of (q g I)^2.
  const double seen = stripe * stripe / (stripe * stripe + sigma * sigma);
  const double noise = std::sqrt(scatter.white_variance / scatter.grain_variance * seen * std::sqrt(seen));
  if (noise > kMostNoise) return std::nullopt;
  return std::max(noise, kLeastNoise);
}

template <class T>
bool recentre_in_grain(ImageView<T> image, const DerivativeKernels& kernels, const CommonScatter& common,
                       const LineRange& range, LineSet& lines, RowDifferences& differences, GrainWorkspace& w,
                       RowScatterWorkspace& rows) {
  if (range.size() < 2 || differences.rows == 0) return false;
  const RowScatter scatter = fit_scatter(differences, common);
  const double stripe = sigma_of_full_width(lines.points[range.begin + range.size() / 2].width);
  const auto noise = noise_over_grain(scatter, stripe, kernels.sigma);
  if (!noise || stripe < kLeastStripe) return false;
  const GrainWeights weights = make_grain_weights(stripe, kernels, *noise);
  w.rows.assign(range.size(), {});
  for (std::size_t i = 0; i < range.size(); ++i) {
    const StripePoint& p = lines.points[range.begin + i];
    if ((p.flags & (kStripeBridged | kStripeSaturated)) != 0 || !(p.strength > 0)) continue;
    const bool straight = !bends_at(lines, range, range.begin + i, kernels.sigma);
    if (straight || !bends_at(lines, range, range.begin + i, kernels.sigma, kSharpRadius))
      sum_row(image, weights, p, w.rows[i]);
    w.rows[i].tells_scatter = w.rows[i].usable && straight;
  }
  const double step = length_of(lines, range) / static_cast<double>(range.size() - 1);
  make_along(kernels.sigma / std::max(step, 0.5), w.along);
  find_centres(w);
  const double cosine = find_moves(w, rows.offsets);
  const RowDifferences anew = differences_of_rows(kernels.sigma, cosine, rows);
  if (anew.rows == 0 || !is_better(scatter, fit_scatter(anew, common), kernels.sigma, w)) return false;
  move_points(range, w, lines);
  differences = anew;
  return true;
}

template bool recentre_in_grain<std::uint8_t>(ImageView8, const DerivativeKernels&, const CommonScatter&,
                                              const LineRange&, LineSet&, RowDifferences&, GrainWorkspace&,
                                              RowScatterWorkspace&);
template bool recentre_in_grain<std::uint16_t>(ImageView16, const DerivativeKernels&, const CommonScatter&,
                                               const LineRange&, LineSet&, RowDifferences&, GrainWorkspace&,
                                               RowScatterWorkspace&);

}  // namespace lightstripe
