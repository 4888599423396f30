// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/row_scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "extraction/kernels/kernels_window.h"
#include "extraction/lines/row_crossing.h"

namespace lightstripe {
namespace {

constexpr double kIndependent = 0.3989422804;  // 1 / sqrt(2 pi): the grain of rows without correlation
constexpr double kRootTwoPi = 2.5066282746;
constexpr std::size_t kLeastRows = 24;
constexpr std::size_t kLags = RowDifferences::kLags;
using LagValues = std::array<double, kLags>;  ///< of rows 1, 2, ... apart
/// Rows that the common variance counts for beside a line's own.
constexpr double kCommonRows = 100;
/// A mean square over n rows scatters by some 1.7 / sqrt(n) of itself: misfits of six lags, times n, that
/// differ by less than this are equally good. Rows count as independent unless they clearly are not.
constexpr double kTolerance = 1, kToleranceOfWhite = 25, kToleranceOfAnother = 3;  // of another line

/// A row that crosses a line obliquely looks at it across with a scale smaller by the cosine.
struct ObliqueView {
  double square = 1;  ///< of the stripe's standard deviation, px^2
  double sigma2 = 1;  ///< of the kernels, px^2

  /// Of the second derivative across by the smaller scale over that by the kernels' own:
  /// ((s^2 + sigma^2) / (s^2 + sigma^2 cos^2))^(3/2).
  double sharper(double cosine) const {
    const double ratio = (square + sigma2) / (square + sigma2 * cosine * cosine);
    return ratio * std::sqrt(ratio);
  }
};

/// What a centre by the kernels' own scale errs by in speckle, over that of the row, for `sharper` at this
/// cosine. Speckle is as strong as the light: its variance goes as (1 / sigma^2 + 1 / s^2)^(3/2).
double error_in_speckle(double cosine, double sharper) {
  return std::sqrt(cosine * cosine * cosine * sharper);
}

/// The centre of one row less that of the line, px along the row, for kernels along the row only.
/// `strength`: of the row's own scale, across the line.
template <class T>
double row_offset(ImageView<T> image, const DerivativeKernels& kernels, const RowCrossing& c,
                  double strength) {
  const int count = c.is_row ? image.width : image.height;
  const std::ptrdiff_t step = c.is_row ? 1 : image.stride;
  const T* line = c.is_row ? image.row(c.index) : image.data + c.index;
  const PhasedPosition at = to_phase(c.centre);
  const float* weights = kernels.phase(at.phase) + kernels.pitch;  // of the first derivative
  const int first = at.pixel - kernels.radius;
  float slope = 0;
  if (first >= 0 && first + kernels.taps <= count) {
    slope = weighted_sum(line + first * step, step, weights, kernels.taps);
  } else {
    for (int k = 0; k < kernels.taps; ++k)
      slope += weights[k] * static_cast<float>(line[std::clamp(first + k, 0, count - 1) * step]);
  }
  return at.value() - c.centre + double{slope} / (strength * c.cosine * c.cosine);
}

/// Each row's centre less the line's, px across the line, as large as the kernels' own scale would scatter in
/// speckle; rows in order, NaN where one does not follow the other. Returns the mean cosine.
template <class T>
double collect_offsets(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                       const LineRange& r, const ObliqueView& view, std::vector<float>& offsets) {
  RowOffsets rows(offsets);
  for (std::size_t i = r.begin; i < r.end; ++i) {
    const StripePoint& p = lines.points[i];
    const RowCrossing c = row_crossing_at(p);
    const bool outside = c.index < 0 || c.index >= (c.is_row ? image.height : image.width);
    const bool usable = (p.flags & kStripeBridged) == 0 && p.strength > 0 && !outside;
    if (!usable || bends_at(lines, r, i, kernels.sigma)) {
      rows.skip();
      continue;
    }
    if (rows.has(c)) continue;
    const double sharper = view.sharper(c.cosine);
    const double offset = row_offset(image, kernels, c, p.strength * sharper);
    rows.add(c, static_cast<float>(c.cosine * offset * error_in_speckle(c.cosine, sharper)));
  }
  return rows.mean_cosine();
}

void find_runs(const std::vector<float>& offsets, std::vector<RowScatterWorkspace::Run>& runs) {
  runs.clear();
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (std::isnan(offsets[i])) continue;
    if (i == 0 || std::isnan(offsets[i - 1])) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
}

/// The sum of what `values` hold up to `limit`. Four sums, which do not wait for each other.
double bounded_sum(const std::vector<float>& values, float limit) {
  std::array<float, 4> sums{};
  std::size_t i = 0;
  for (; i + 4 <= values.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) sums[k] += std::min(values[i + k], limit);
  for (; i < values.size(); ++i) sums[0] += std::min(values[i], limit);
  return double{sums[0]} + double{sums[1]} + double{sums[2]} + double{sums[3]};
}

/// Four maxima, which do not wait for each other.
float largest_of(const std::vector<float>& values) {
  std::array<float, 4> largest{};
  std::size_t i = 0;
  for (; i + 4 <= values.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) largest[k] = std::max(largest[k], values[i + k]);
  for (; i < values.size(); ++i) largest[0] = std::max(largest[0], values[i]);
  return std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3]));
}

/// A sixth of the squared second differences of rows `lag` apart.
void square_differences(const RowScatterWorkspace& w, std::size_t lag, std::vector<float>& squares) {
  std::size_t count = 0;
  for (const auto& run : w.runs) count += run.end - run.begin > 2 * lag ? run.end - run.begin - 2 * lag : 0;
  squares.resize(count);
  float* out = squares.data();
  for (const auto& run : w.runs) {
    if (run.end - run.begin <= 2 * lag) continue;
    const std::size_t length = run.end - run.begin - 2 * lag;
    const float *first = w.offsets.data() + run.begin, *middle = first + lag, *last = middle + lag;
    // Plain enough for the compiler to make vectors of it.
    for (std::size_t i = 0; i < length; ++i) {
      const float difference = last[i] - 2 * middle[i] + first[i];
      out[i] = difference * difference * (1.0F / 6);
    }
    out += length;
  }
}

/// A sixth of the mean squared second difference of rows `lag` apart, which bends of the line hardly touch;
/// single values of more than 16 times the mean count as that much, so that a spot or a crossing does not
/// decide. -1 for too few rows.
double second_difference(const RowScatterWorkspace& w, std::size_t lag, std::vector<float>& squares) {
  square_differences(w, lag, squares);
  if (squares.size() < kLeastRows) return -1;
  const auto count = static_cast<double>(squares.size());
  double mean = bounded_sum(squares, std::numeric_limits<float>::max()) / count;
  for (int pass = 0; pass < 2; ++pass) {
    const auto limit = static_cast<float>(16 * mean);
    if (largest_of(squares) <= limit) break;  // nothing is bounded, now or later
    mean = bounded_sum(squares, limit) / count;
  }
  return mean;
}

/// Non-negative least squares of `seen` by two shapes, each lag weighted by its own size.
struct TwoShares {
  double white = 0, grained = 0, misfit = 0;
};
TwoShares fit_shares(const LagValues& seen, const LagValues& white, const LagValues& grained) {
  double ww = 0, wg = 0, gg = 0, ws = 0, gs = 0, ss = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const double scale = 1 / seen[k], w = white[k] * scale, g = grained[k] * scale;
    ww += w * w;
    wg += w * g;
    gg += g * g;
    ws += w;
    gs += g;
    ss += 1;
  }
  TwoShares out;
  const double determinant = ww * gg - wg * wg;
  if (determinant > 1e-9 * ww * gg) {
    out.white = (gg * ws - wg * gs) / determinant;
    out.grained = (ww * gs - wg * ws) / determinant;
  }
  if (determinant <= 1e-9 * ww * gg || out.white < 0) out = {0, gs / gg, 0};
  if (out.grained < 0) out = {ws / ww, 0, 0};
  out.misfit = ss - 2 * (out.white * ws + out.grained * gs) + out.white * out.white * ww +
               2 * out.white * out.grained * wg + out.grained * out.grained * gg;
  return out;
}

/// By how much the correlation of a Gaussian of variance `s2` has fallen 1, 2 ... 2 kLags steps away.
using Fallen = std::array<double, 2 * kLags + 1>;
Fallen fallen_by_steps(double s2, double step) {
  Fallen out{};
  for (std::size_t m = 1; m < out.size(); ++m) {
    if (m > kLags && m % 2 != 0) continue;  // of the long distances only twice the short ones are needed
    const double distance = static_cast<double>(m) * step;
    out.at(m) = 1 - std::exp(-0.5 * distance * distance / s2);
  }
  return out;
}

/// What second_difference would be for a scatter of variance 1: rows are seen against the line, which is
/// itself their mean by a Gaussian of sigma.
LagValues expected_differences(double grain, double sigma, double step) {
  const double t2 = grain * grain;
  const std::array<double, 3> squares{0, sigma * sigma, 2 * sigma * sigma};
  std::array<LagValues, 3> smoothed{};
  for (std::size_t s = 0; s < squares.size(); ++s) {
    const double s2 = t2 + squares.at(s);
    const Fallen fallen = fallen_by_steps(s2, step);
    for (std::size_t k = 0; k < kLags; ++k)
      smoothed.at(s).at(k) = std::sqrt(t2 / s2) * (8 * fallen.at(k + 1) - 2 * fallen.at(2 * k + 2)) / 6;
  }
  LagValues out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = smoothed[0][k] - 2 * smoothed[1][k] + smoothed[2][k];
  return out;
}

/// The grains that are tried, px; the first is for rows without grain.
struct Grains {
  static constexpr std::size_t kCount = 24;
  std::array<double, kCount> px{};

  Grains(double step, double sigma) {
    const double ratio = std::pow(2 * sigma / (0.6 * step), 1.0 / (kCount - 2));
    for (std::size_t i = 1; i < kCount; ++i)
      px.at(i) = i == 1 ? 0.6 * step : px.at(i - 1) * std::max(ratio, 1.01);
  }
};

TwoShares shares_of(const RowDifferences& line, const LagValues& white, double grain) {
  return fit_shares(line.seen, white, grain > 0 ? expected_differences(grain, line.sigma, line.step) : white);
}

/// The smallest grain that is as good as the best within the statistics of so many rows: coarse grain shows
/// little in the differences, but weighs much in the points. 0 where the rows may be independent.
double common_grain(std::span<const RowDifferences> lines) {
  double step = std::numeric_limits<double>::max(), sigma = 0, count = 0;
  for (const RowDifferences& line : lines) {
    if (line.rows == 0) continue;
    step = std::min(step, line.step);
    sigma = std::max(sigma, line.sigma);
    count += 1;
  }
  if (count == 0) return 0;
  const Grains grains(step, sigma);
  std::array<double, Grains::kCount> misfits{};
  const auto add_misfits = [&](std::size_t first, std::size_t end) {
    for (const RowDifferences& line : lines) {
      if (line.rows == 0) continue;
      for (std::size_t i = first; i < end; ++i)
        misfits.at(i) += line.rows * shares_of(line, line.white, grains.px.at(i)).misfit;
    }
  };
  const double tolerance = kToleranceOfWhite + kToleranceOfAnother * (count - 1);
  add_misfits(0, 1);
  if (misfits[0] <= tolerance) return 0;  // no grain can be better by more than that
  add_misfits(1, misfits.size());
  const double least = *std::min_element(misfits.begin(), misfits.end());
  if (misfits[0] <= least + tolerance) return 0;
  std::size_t best = 1;
  while (misfits.at(best) > least + kTolerance) ++best;
  return grains.px.at(best);
}

double smoothed_variance(double variance, double grain, double sigma) {
  return variance * grain / std::sqrt(grain * grain + 2 * sigma * sigma);
}

}  // namespace

double RowScatter::white_point(double sigma) const {
  return smoothed_variance(white_variance, row_px, sigma);
}

double RowScatter::grained_point(double sigma) const {
  return smoothed_variance(grain_variance, grain_px, sigma);
}

double RowScatter::grained_density() const { return kRootTwoPi * grain_variance * grain_px; }

RowDifferences differences_of_rows(double sigma, double cosine, RowScatterWorkspace& w) {
  RowDifferences line;
  line.sigma = sigma;
  find_runs(w.offsets, w.runs);
  line.step = 1 / cosine;
  for (std::size_t k = 0; k < kLags; ++k) {
    line.seen.at(k) = second_difference(w, k + 1, w.squares);
    if (!(line.seen.at(k) > 0)) return line;
  }
  line.rows = static_cast<double>(w.squares.size());
  line.white = expected_differences(kIndependent * line.step, line.sigma, line.step);
  return line;
}

template <class T>
RowDifferences look_at_rows(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                            const LineRange& range, RowScatterWorkspace& w) {
  if (range.size() == 0) return {.sigma = kernels.sigma};
  const double width = lines.points[range.begin + range.size() / 2].width;  // 2 sqrt(3) s
  const ObliqueView view{std::max(width * width / 12, 0.25), kernels.sigma * kernels.sigma};
  const double cosine = collect_offsets(image, kernels, lines, range, view, w.offsets);
  RowDifferences line = differences_of_rows(kernels.sigma, cosine, w);
  // In white noise the variance goes as (s^2 + sigma^2)^3 / sigma^3: so much more than in speckle.
  line.white_factor = view.sharper(cosine);
  return line;
}

CommonScatter common_scatter(std::span<const RowDifferences> lines) {
  return common_scatter(lines, common_grain(lines));
}

CommonScatter common_scatter(std::span<const RowDifferences> lines, double grain_px) {
  CommonScatter common{grain_px, 0};
  if (common.grain_px == 0) return common;
  double rows = 0, variance = 0;
  for (const RowDifferences& line : lines) {
    if (line.rows == 0) continue;
    rows += line.rows;
    variance += line.rows * shares_of(line, line.white, common.grain_px).grained / line.sigma;
  }
  common.grain_per_px = variance / rows;
  return common;
}

RowScatter fit_scatter(const RowDifferences& line, const CommonScatter& common) {
  RowScatter scatter;
  scatter.row_px = kIndependent * line.step;
  scatter.rows = line.rows;
  if (common.grain_px > 0) scatter.grain_px = common.grain_px;
  if (line.rows > 0) {
    const TwoShares shares = shares_of(line, line.white, common.grain_px);
    const double grained = common.grain_px > 0 ? shares.grained : 0.0;
    scatter.white_variance =
        line.white_factor * (shares.white + (common.grain_px > 0 ? 0.0 : shares.grained));
    scatter.grain_variance = grained;
  }
  scatter.grain_variance =
      (line.rows * scatter.grain_variance + kCommonRows * common.grain_per_px * line.sigma) /
      (line.rows + kCommonRows);
  return scatter;
}

template <class T>
RowScatter measure_row_scatter(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                               const LineRange& range, RowScatterWorkspace& w) {
  const RowDifferences line = look_at_rows(image, kernels, lines, range, w);
  if (line.rows == 0) return {};
  return fit_scatter(line, common_scatter({&line, 1}));
}

template RowDifferences look_at_rows<std::uint8_t>(ImageView8, const DerivativeKernels&, const LineSet&,
                                                   const LineRange&, RowScatterWorkspace&);
template RowDifferences look_at_rows<std::uint16_t>(ImageView16, const DerivativeKernels&, const LineSet&,
                                                    const LineRange&, RowScatterWorkspace&);
template RowScatter measure_row_scatter<std::uint8_t>(ImageView8, const DerivativeKernels&, const LineSet&,
                                                      const LineRange&, RowScatterWorkspace&);
template RowScatter measure_row_scatter<std::uint16_t>(ImageView16, const DerivativeKernels&, const LineSet&,
                                                       const LineRange&, RowScatterWorkspace&);

}  // namespace lightstripe
