// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/end_cuts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include "core/robust.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/border_ends.h"
#include "extraction/lines/end_view.h"
#include "extraction/lines/local_fit.h"
#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

constexpr double kEndReach = 4;  // sigma of the kernels, from the end on
constexpr double kFadeIn = 1.3;  // sigma: over which the moves begin
constexpr double kAlong = 0.65;  // sigma: of the mean over neighbouring cuts
/// Sigma: beyond it the cut sees another light.
constexpr double kFarthestMove = 0.4;
/// Of the stripe's standard deviation: where the cuts scatter less, the strengths along the line are good
/// enough to tell how the light ends, and line_ends.h knows better.
constexpr double kLeastScatter = 0.05;
/// In grain the points near an end are that much farther off than they know: they guess their end's angle
/// from strengths that the grain has spoilt (rendered rails, their far edges: 1.5 to 3).
constexpr double kEndDoubt = 2;
constexpr int kTapsPerStripe = 3;                        // in a standard deviation of the stripe
constexpr double kCutReach = 3.2;                        // standard deviations of the stripe
constexpr double kLeastCutStripe = 0.8;                  // px: pixels blur a narrower one
constexpr std::size_t kFewestCuts = 16, kMostCuts = 32;  // that tell a line's scatter
constexpr float kNoLight = std::numeric_limits<float>::quiet_NaN();

void make_taps(std::vector<EndCutWorkspace::Tap>& taps) {
  constexpr int kHalf = static_cast<int>(kCutReach * kTapsPerStripe);
  taps.clear();
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double q = static_cast<double>(i) / kTapsPerStripe, g = std::exp(-0.5 * q * q);
    taps.push_back({static_cast<float>(g), static_cast<float>(q * g), static_cast<float>((1 - q * q) * g)});
  }
}

/// Where a cut runs: its middle and its unit direction.
struct CutLine {
  double x = 0, y = 0, across_x = 1, across_y = 0;
};

/// What the taps see of a cut; a slope of 0 where the picture ends.
struct CutSums {
  double shift = 0, slope = 0, light = 0;
};

template <class T>
CutSums sums_of_cut(ImageView<T> image, const CutLine& cut, double stripe,
                    std::span<const EndCutWorkspace::Tap> taps) {
  const double step = stripe / kTapsPerStripe, half = 0.5 * static_cast<double>(taps.size() - 1) * step;
  const double far_x = half * std::abs(cut.across_x) + 1, far_y = half * std::abs(cut.across_y) + 1;
  if (cut.x < far_x || cut.y < far_y || cut.x > image.width - 1 - far_x || cut.y > image.height - 1 - far_y)
    return {};
  float shift = 0, slope = 0, light = 0, weights = 0, first = 0, level = 0;
  double x = cut.x - half * cut.across_x, y = cut.y - half * cut.across_y;
  for (std::size_t i = 0; i < taps.size(); ++i, x += step * cut.across_x, y += step * cut.across_y) {
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const T *upper = image.row(row) + column, *lower = image.row(row + 1) + column;
    const auto right = static_cast<float>(x - column), down = static_cast<float>(y - row);
    const auto blend = [right](const T* p) {
      return static_cast<float>(p[0]) + right * (static_cast<float>(p[1]) - static_cast<float>(p[0]));
    };
    level = blend(upper) + down * (blend(lower) - blend(upper));
    if (i == 0) first = level;
    shift += taps[i].shift * level;
    slope += taps[i].slope * level;
    light += taps[i].light * level;
    weights += taps[i].light;
  }
  return {shift, slope, light - weights * std::min(first, level)};
}

/// Across the chord over four points to both sides: near ends the kernels' normals turn with their points.
CutLine cut_line_at(const EndView& end, std::size_t i) {
  const StripePoint &p = end[i], &a = end[i - std::min<std::size_t>(i, 4)],
                    &b = end[std::min(i + 4, end.size() - 1)];
  const double x = b.y - a.y, y = a.x - b.x, length = std::sqrt(x * x + y * y);
  if (length < 1e-9) return {p.x, p.y, p.normal_x, p.normal_y};
  const double side = x * p.normal_x + y * p.normal_y < 0 ? -1 : 1;
  return {p.x, p.y, side * x / length, side * y / length};
}

/// The light across the line from one of its points.
template <class T>
EndCutWorkspace::Cut cut_at(ImageView<T> image, const EndView& end, std::size_t i, double stripe, int passes,
                            const EndCutWorkspace& w) {
  constexpr double kLongestStep = 0.5;  // standard deviations of the stripe
  const StripePoint& p = end[i];
  if ((p.flags & (kStripeBridged | kStripeSaturated)) != 0) return {.centre = kNoLight};
  CutLine cut = cut_line_at(end, i);
  CutSums sums;
  for (int pass = 0; pass < passes; ++pass) {
    sums = sums_of_cut(image, cut, stripe, w.taps);
    if (!(sums.slope > 0)) return {.centre = kNoLight};
    const double move = stripe * std::clamp(sums.shift / sums.slope, -kLongestStep, kLongestStep);
    cut.x += move * cut.across_x;
    cut.y += move * cut.across_y;
  }
  return {static_cast<float>((cut.x - p.x) * p.normal_x + (cut.y - p.y) * p.normal_y),
          static_cast<float>(sums.slope), static_cast<float>(sums.light)};
}

/// Variance of a profile by what a Gaussian of variance 1 sees of it.
double profile_variance(double slope, double light) { return std::max(0.0, light / slope - 1); }

/// What the cuts of a line have in common.
struct CutScatter {
  double usual = 0;     ///< px: where cuts see the light, against the kernels
  double variance = 0;  ///< px^2, of one cut
  double profile = 1;   ///< variance of the light across the line, in those of the stripe
};

/// By cuts between the ends; a variance of 0 where there are too few.
template <class T>
CutScatter scatter_of_cuts(ImageView<T> image, std::span<StripePoint> line, std::size_t ends, double stripe,
                           EndCutWorkspace& w) {
  if (line.size() < 2 * ends + kFewestCuts) return {};
  const std::size_t inside = line.size() - 2 * ends, step = 1 + inside / kMostCuts;
  w.values.clear();
  double slope = 0, light = 0;
  for (std::size_t i = ends; i < ends + inside; i += step) {
    const EndCutWorkspace::Cut cut = cut_at(image, {line, false}, i, stripe, 1, w);
    if (std::isnan(cut.centre)) continue;
    w.values.push_back(cut.centre);
    slope += static_cast<double>(cut.slope);
    light += static_cast<double>(cut.light);
  }
  if (w.values.size() < kFewestCuts) return {};
  const double usual = ranked_median(w.values);
  for (float& value : w.values) value = std::abs(value - static_cast<float>(usual));
  const double scatter = kMadToSigma * ranked_median(w.values);
  return {usual, scatter * scatter, profile_variance(slope, light)};
}

/// The mean of the cuts around a point; squares of 0 where there are none.
struct CutMean {
  double across = 0;   ///< px
  double squares = 0;  ///< sum of the squared weights
  double profile = 1;  ///< CutScatter::profile
};

CutMean mean_of_cuts(const EndCutWorkspace& w, std::size_t i) {
  double sum = 0, weights = 0, squares = 0, slope = 0, light = 0;
  const std::size_t first = i - std::min(i, w.along.size() - 1),
                    last = std::min(i + w.along.size(), w.cuts.size());
  for (std::size_t j = first; j < last; ++j) {
    const EndCutWorkspace::Cut& cut = w.cuts[j];
    if (std::isnan(cut.centre)) continue;
    const auto weight = static_cast<double>(w.along[j < i ? i - j : j - i]);
    sum += weight * static_cast<double>(cut.centre);
    slope += weight * static_cast<double>(cut.slope);
    light += weight * static_cast<double>(cut.light);
    weights += weight;
    squares += weight * weight;
  }
  if (!(weights > 0)) return {};
  return {sum / weights, squares / (weights * weights), profile_variance(slope, light)};
}

/// How far a cut's centre moves where an oblique end has taken one tail of the light, in standard deviations
/// of the stripe, by the variance that is lost: 0.06, 0.17, 0.35, 0.60 and 0.90 where 0.11, 0.22, 0.33, 0.42
/// and 0.48 of it are (a Gaussian stripe, an edge that the lens blurs by half of it), to a fifth.
double shift_of_cut_off(double lost) { return 4 * lost * std::max(0.0, lost); }

/// `reach`: points that may move; `shared`: cuts that share their error.
void move_end(const EndView& end, const CutScatter& scatter, double sigma, double stripe, std::size_t reach,
              double shared, const EndCutWorkspace& w) {
  for (std::size_t i = 0; i < reach; ++i) {
    const CutMean mean = mean_of_cuts(w, i);
    if (!(mean.squares > 0)) continue;
    const double off = mean.across - scatter.usual,
                 variance = scatter.variance * std::min(1.0, mean.squares * shared);
    if (off * off <= variance || std::abs(off) > kFarthestMove * sigma) continue;
    StripePoint& p = end[i];
    const double fade = std::min(1.0, static_cast<double>(reach - i) / (kFadeIn * sigma));
    const double shift = stripe * shift_of_cut_off(1 - mean.profile / scatter.profile),
                 own = kEndDoubt * p.sigma_px, trust = own * own / std::max(1e-12, own * own + shift * shift);
    const double share = fade * trust * (1 - variance / (off * off));
    p.x += share * off * p.normal_x;
    p.y += share * off * p.normal_y;
    const double stays = (1 - share) * p.sigma_px;
    p.sigma_px = std::sqrt(stays * stays + share * share * (variance + shift * shift) +
                           share * (1 - share) * off * off);
  }
}

double mean_step(std::span<const StripePoint> line) {
  const StripePoint &a = line.front(), &b = line[std::min<std::size_t>(8, line.size() - 1)];
  const double dx = b.x - a.x, dy = b.y - a.y;
  return std::clamp(std::sqrt(dx * dx + dy * dy) / 8, 0.5, 2.0);
}

template <class T>
void recentre_line_ends(ImageView<T> image, double sigma, double grain_px, std::span<StripePoint> line,
                        EndCutWorkspace& w) {
  const double stripe = std::max(kLeastCutStripe, sigma_of_full_width(line[line.size() / 2].width));
  const double step = mean_step(line);
  const auto points_in = [step](double px) { return static_cast<std::size_t>(std::ceil(px / step)); };
  const std::size_t reach = points_in(kEndReach * sigma);
  w.along.clear();
  for (std::size_t d = 0; d <= points_in(3 * kAlong * sigma); ++d) {
    const double distance = static_cast<double>(d) * step / (kAlong * sigma);
    w.along.push_back(static_cast<float>(std::exp(-0.5 * distance * distance)));
  }
  const CutScatter scatter = scatter_of_cuts(image, line, reach, stripe, w);
  if (scatter.variance < std::pow(kLeastScatter * stripe, 2) || !(scatter.profile > 0)) return;
  const double shared = std::max(1.0, std::sqrt(2 * std::numbers::pi) * grain_px / step);
  for (const bool from_back : {false, true}) {
    const EndView end{line, from_back};
    if (is_near_border(image, end[0], 3 * sigma)) continue;  // there the light goes on
    const std::size_t count = std::min(reach + w.along.size(), line.size());
    if (joined_end(end.stretch(count), 0) < count) continue;
    w.cuts.clear();
    for (std::size_t i = 0; i < count; ++i) w.cuts.push_back(cut_at(image, end, i, stripe, 3, w));
    move_end(end, scatter, sigma, stripe, reach, shared, w);
  }
}

}  // namespace

template <class T>
void recentre_ends(ImageView<T> image, const DerivativeKernels& kernels, double grain_px, LineSet& lines,
                   EndCutWorkspace& workspace) {
  if (workspace.taps.empty()) make_taps(workspace.taps);
  for (const LineRange& r : lines.lines)
    recentre_line_ends(image, kernels.sigma, grain_px, std::span(lines.points).subspan(r.begin, r.size()),
                       workspace);
}

template void recentre_ends<std::uint8_t>(ImageView8, const DerivativeKernels&, double, LineSet&,
                                          EndCutWorkspace&);
template void recentre_ends<std::uint16_t>(ImageView16, const DerivativeKernels&, double, LineSet&,
                                           EndCutWorkspace&);

}  // namespace lightstripe
