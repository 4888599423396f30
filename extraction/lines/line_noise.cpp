// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/robust.h"
#include "extraction/follow/direction_guided_ridge.h"
#include "extraction/follow/line_point.h"
#include "extraction/kernels/width_rule.h"
#include "extraction/lines/cross_profile.h"
#include "extraction/lines/line_measure.h"
#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

/// How fast grey levels fall beside the ridge, by the top of a Gaussian of the point's width: they fall by
/// this times the squared distance.
double fall_of(const StripePoint& p) {
  return 0.5 * static_cast<double>(p.intensity) / std::max(p.width * p.width / 12, 0.25);  // 2 sqrt(3) s
}

/// The ridge's grey value at a point: that of the nearest pixel, put right for its distance from the centre
/// line.
template <class T>
double ridge_grey(ImageView<T> image, const StripePoint& p, double fall) {
  const auto [x, y] = nearest_inside(image, p.x, p.y);
  const double across = (x - p.x) * p.normal_x + (y - p.y) * p.normal_y;
  return image(x, y) + fall * across * across;
}

/// Points of white noise share their error over 2 sqrt(pi) sigma along the line.
constexpr double kSharedBySigma = 3.5449077;

bool is_usable(const StripePoint& p) { return (p.flags & (kStripeBridged | kStripeSaturated)) == 0; }

bool are_neighbours(const StripePoint& a, const StripePoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return dx * dx + dy * dy < 4.0;
}

}  // namespace

template <class T>
double noise_on_ridge(ImageView<T> image, const LineSet& lines, const LineRange& range,
                      double background_noise, std::vector<float>& scratch) {
  constexpr std::size_t kLeast = 20, kEnough = 250;
  const std::size_t step = 1 + range.size() / kEnough;
  scratch.clear();
  for (std::size_t i = range.begin + 1; i + 1 < range.end; i += step) {
    const StripePoint &a = lines.points[i - 1], &b = lines.points[i], &c = lines.points[i + 1];
    if (!is_usable(a) || !is_usable(b) || !is_usable(c) || !are_neighbours(a, b) || !are_neighbours(b, c))
      continue;
    const double fall = fall_of(b);
    const double second =
        ridge_grey(image, a, fall) - 2 * ridge_grey(image, b, fall) + ridge_grey(image, c, fall);
    scratch.push_back(static_cast<float>(std::abs(second)));
  }
  return scratch.size() < kLeast ? background_noise : kSecondDifferenceToSigma * ranked_median(scratch);
}

namespace {

double median_of_line(const LineSet& lines, const LineRange& r, double (*value)(const StripePoint&),
                      std::vector<float>& scratch) {
  scratch.clear();
  for (std::size_t i = r.begin; i < r.end; i += sample_step(r))
    scratch.push_back(static_cast<float>(value(lines.points[i])));
  return ranked_median(scratch);
}

/// Photon noise alone, where a line is too short to measure its scatter: grey levels squared per grey level.
template <class T>
double photon_noise(ImageView<T> image, const LineSet& lines, const LineRange& r, double background_noise,
                    double typical, std::vector<float>& scratch) {
  // The first derivative's kernel sees the flanks: of a Gaussian stripe of its own scale, on average this
  // share of the peak's light, (2/3)^1.5.
  constexpr double kFlankShare = 0.5443;
  const double top = noise_on_ridge(image, lines, r, background_noise, scratch);
  return kFlankShare * std::max(0.0, top * top - background_noise * background_noise) / typical;
}

}  // namespace

namespace {

/// What a line's points have in common, px^2 where not said otherwise.
struct LineErrors {
  double intensity = 1;   ///< typical, grey levels
  double background = 0;  ///< noise, grey levels
  double photons = 0;     ///< at the typical intensity, beyond the background's noise
  double grain = 0;       ///< speckle, texture
  double row = 0;         ///< of a single row's centre
  double left = 0;        ///< more, where the rows are still weighed by the kernels
};

template <class T>
LineErrors errors_of_line(ImageView<T> image, const DerivativeKernels& kernels, double background_noise,
                          const LineSet& lines, LineRange& r, ErrorWorkspace& w) {
  LineErrors e;
  e.background = background_noise;
  e.intensity =
      std::max(1.0, median_of_line(
                        lines, r, [](const StripePoint& p) { return double{p.intensity}; }, w.values));
  const double strength =
      std::max(1e-9, median_of_line(
                         lines, r, [](const StripePoint& p) { return p.strength; }, w.values));
  const double camera = std::pow(centre_sigma(kernels, background_noise, strength), 2);
  r.shared_px = kSharedBySigma * kernels.sigma;
  const RowScatter scatter = fit_scatter(w.differences[w.next], w.common);
  if (!w.by_kernels.empty())
    e.left = std::max(0.0, fit_scatter(w.by_kernels[w.next], w.common_by_kernels).of_point(kernels.sigma) -
                               scatter.of_point(kernels.sigma));
  ++w.next;
  e.grain = scatter.grained_point(kernels.sigma);
  const double photons = photon_noise(image, lines, r, background_noise, e.intensity, w.values);
  e.photons = std::pow(centre_sigma(kernels, std::sqrt(photons * e.intensity), strength), 2);
  e.row = kSharedBySigma * kernels.sigma * (camera + e.photons);
  if (scatter.rows == 0) {
    e.row += scatter.grain_variance;
    return e;
  }
  // Speckle makes the ridge noisy as well: then the rows alone decide. Without it the ridge knows better,
  // unless the rows clearly disagree (clipping, which hides the ridge's noise).
  const double white = scatter.white_point(kernels.sigma);
  const double doubt = e.grain > 0 ? 0 : 3 * 1.7 / std::sqrt(scatter.rows) * white;
  const double by_rows = std::max(0.0, white - camera - doubt);
  e.photons = e.grain > 0 ? by_rows : std::max(e.photons, by_rows);
  e.row = scatter.white_variance + scatter.grain_variance;
  const double variance = std::max(1e-12, camera + e.photons + e.grain);
  r.shared_px =
      (kSharedBySigma * kernels.sigma * (camera + e.photons) + scatter.grained_density()) / variance;
  return e;
}

/// Which share of a point's kernel lies beyond the picture's border, where the last row stands for all.
template <class T>
double share_outside(ImageView<T> image, double sigma, const StripePoint& p) {
  const double along_x = std::max(std::abs(p.normal_y), 1e-3), along_y = std::max(std::abs(p.normal_x), 1e-3);
  const double inside = std::min(std::min(p.x, image.width - 1 - p.x) / along_x,
                                 std::min(p.y, image.height - 1 - p.y) / along_y);
  return inside > 3 * sigma ? 0.0 : 0.5 * std::erfc((inside + 0.5) / (sigma * std::numbers::sqrt2));
}

/// How far beside a bridge light like the line's own is, px, over sqrt(2): where the bridge itself runs in
/// the dark, the line may as well go there. 0: none, or a spot's bridge, which knows it. Grains of the line's
/// own bar do not count.
template <class T>
double doubt_of_bridge(ImageView<T> image, const StripePoint& p, double intensity) {
  if ((p.flags & kStripeBridged) == 0) return 0;
  if (p.sigma_px > 0) return p.sigma_px;
  const auto level = [&](double across) {
    const auto [x, y] = nearest_inside(image, p.x + across * p.normal_x, p.y + across * p.normal_y);
    return static_cast<double>(image(x, y));
  };
  double brightest = level(0) + 0.5 * intensity, place = 0;
  for (double across = 0.5 * p.width + 1; across <= 2 * p.width; across += 1)
    for (const double seen : {level(-across), level(across)}) {
      if (seen <= brightest) continue;
      brightest = seen;
      place = across;
    }
  return place / std::numbers::sqrt2;
}

/// How a point was come by.
struct PointPlace {
  double recentred = 0;  ///< the share of the point's rows that grain_centres weighed
  double outside = 0;    ///< that of its kernels beyond the border
  double gap = 0;        ///< points of the bridge that it belongs to
  double beside = 0;     ///< px: doubt_of_bridge()
};

double predicted_error(const LineErrors& e, const DerivativeKernels& kernels, const StripePoint& p,
                       const PointPlace& place) {
  const double own = centre_sigma(kernels, e.background, p.strength);
  // Photons are the noisier the dimmer the line is; speckle is not.
  const double light = std::max(static_cast<double>(p.intensity), 0.1 * e.intensity);
  const double photons = e.photons * e.intensity / light, border = place.outside * place.outside * e.row;
  const double left = (1 - place.recentred) * e.left;
  if ((p.flags & kStripeBridged) == 0) return std::sqrt(own * own + photons + e.grain + left + border);
  // As good as the curve between its neighbours: it has their scatter, and more. In grain the gap is a dark
  // grain: bridges of rendered ones err by 1.2 times what the points beside them do where they are two scales
  // long, by 2.2 times at six; scales of kernels that suit the stripe. Without grain the shape is in doubt.
  constexpr double kGapOfGrain = 3, kSuitable = 2;  // scales; of the stripe's own
  const double gap =
      place.gap / (kGapOfGrain * std::max(kernels.sigma, kSuitable * sigma_of_full_width(p.width)));
  const double longer = 1 + gap * gap;
  const double camera = e.grain > 0 ? 5 * own : std::max(5 * own, 0.1 * kernels.sigma);
  return std::sqrt(camera * camera + photons + longer * e.grain + left + border +
                   place.beside * place.beside);
}

/// The points from `begin` on that have one sense: bridged, or not.
std::size_t end_of_stretch(const LineSet& lines, const LineRange& r, std::size_t begin) {
  const auto is_bridged = [&](std::size_t i) { return (lines.points[i].flags & kStripeBridged) != 0; };
  std::size_t end = begin + 1;
  while (end < r.end && is_bridged(end) == is_bridged(begin)) ++end;
  return end;
}

}  // namespace

template <class T>
void look_at_scatter(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                     ErrorWorkspace& w) {
  for (const LineRange& r : lines.lines)
    w.differences.push_back(look_at_rows(image, kernels, lines, r, w.rows));
}

template <class T>
void recentre_lines(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines, ErrorWorkspace& w) {
  lines.recentred.assign(lines.points.size(), 0);
  for (const LineRange& r : lines.lines) {
    recentre_in_grain(image, kernels, w.common_by_kernels, r, lines, w.differences[w.next], w.grain, w.rows);
    ++w.next;
  }
}

template <class T>
void predict_errors(ImageView<T> image, const DerivativeKernels& kernels, double background_noise,
                    LineSet& lines, ErrorWorkspace& w) {
  for (LineRange& r : lines.lines) {
    const LineErrors errors = errors_of_line(image, kernels, background_noise, lines, r, w);
    for (std::size_t begin = r.begin, end = 0; begin < r.end; begin = end) {
      end = end_of_stretch(lines, r, begin);
      const auto gap = static_cast<double>(end - begin);
      for (std::size_t i = begin; i < end; ++i) {
        StripePoint& p = lines.points[i];
        const PointPlace place{i < lines.recentred.size() ? lines.recentred[i] : 0.0,
                               share_outside(image, kernels.sigma, p), gap,
                               doubt_of_bridge(image, p, errors.intensity)};
        p.sigma_px = predicted_error(errors, kernels, p, place);
      }
    }
  }
}

template double noise_on_ridge<std::uint8_t>(ImageView8, const LineSet&, const LineRange&, double,
                                             std::vector<float>&);
template double noise_on_ridge<std::uint16_t>(ImageView16, const LineSet&, const LineRange&, double,
                                              std::vector<float>&);
template void look_at_scatter<std::uint8_t>(ImageView8, const DerivativeKernels&, const LineSet&,
                                            ErrorWorkspace&);
template void look_at_scatter<std::uint16_t>(ImageView16, const DerivativeKernels&, const LineSet&,
                                             ErrorWorkspace&);
template void recentre_lines<std::uint8_t>(ImageView8, const DerivativeKernels&, LineSet&, ErrorWorkspace&);
template void recentre_lines<std::uint16_t>(ImageView16, const DerivativeKernels&, LineSet&, ErrorWorkspace&);
template void predict_errors<std::uint8_t>(ImageView8, const DerivativeKernels&, double, LineSet&,
                                           ErrorWorkspace&);
template void predict_errors<std::uint16_t>(ImageView16, const DerivativeKernels&, double, LineSet&,
                                            ErrorWorkspace&);

}  // namespace lightstripe
