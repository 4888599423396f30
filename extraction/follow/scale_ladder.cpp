// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/scale_ladder.h"

#include <algorithm>
#include <cmath>

#include "core/robust.h"
#include "extraction/follow/line_point.h"
#include "extraction/image/noise.h"
#include "extraction/kernels/kernels_scan.h"
#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

constexpr int kSmallestLevel = 24;     // px, of a binned image's sides
constexpr double kNoisePixels = 4000;  // of a level that tell its noise, to 2 %
constexpr double kClearOfNoise = 7;    // standard deviations of the strength
constexpr double kFaintestHeight = 3;  // grey levels, of a stripe's peak
constexpr double kMostAlong = 0.4;     // of the curvature across: a dot has 1, a line 0
constexpr double kNoisyAlong = 2.5;    // standard deviations that noise may add to it
constexpr double kOwnMaximum = 0.5;    // of the largest one: a narrower maximum as high as this is the line's
constexpr std::size_t kSamples = 16;   // points of a line that are looked at, at most
constexpr double kSampleSpacing = 1.5;  // sigma between them, at least: nearer ones see the same pixels

/// Columns [begin, end) of a row of the coarser image.
template <class T>
void halve_row(const T* a, const T* b, int begin, int end, T* out) {
  if (begin < end)
    halve_rows(a + 2 * begin, b + 2 * begin, static_cast<std::size_t>(end - begin), out + begin);
}

template <class T>
void halve(ImageView<T> from, Image<T>& to) {
  to.width = from.width / 2;
  to.height = from.height / 2;
  to.pixels.resize(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  for (int y = 0; y < to.height; ++y) halve_row(from.row(2 * y), from.row(2 * y + 1), 0, to.width, to.row(y));
}

template <class T>
void halve(ImageView<T> from, const SearchWindows& windows, int level, Image<T>& to) {
  to.width = from.width / 2;
  to.height = from.height / 2;
  // Black, not what an earlier image left there.
  to.pixels.assign(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height), T{});
  for (int y = 0; y < to.height; ++y)
    for (const ColumnSpan& span : windows.spans(y << level))
      halve_row(from.row(2 * y), from.row(2 * y + 1), span.begin >> level,
                std::min(span.end >> level, to.width), to.row(y));
}

/// `make`(finer level, k, level k's memory), `noise_of`(level k, k).
template <class T, class Make, class NoiseOf>
void add_levels(ImageView<T> image, double noise, ImagePyramid<T>& pyramid, const Make& make,
                const NoiseOf& noise_of) {
  pyramid.levels[0] = image;
  pyramid.noise[0] = noise;
  pyramid.count = 1;
  for (std::size_t k = 1; k < ImagePyramid<T>::kMostLevels; ++k) {
    const ImageView<T> finer = pyramid.levels[k - 1];
    if (std::min(finer.width, finer.height) < 2 * kSmallestLevel) break;
    make(finer, static_cast<int>(k), pyramid.binned[k - 1]);
    pyramid.levels[k] = pyramid.binned[k - 1].view();
    pyramid.noise[k] = noise_of(pyramid.levels[k], static_cast<int>(k));
    ++pyramid.count;
  }
}

/// A place of the image in one level's pixels.
double in_level(double coordinate, int bin) { return (coordinate + 0.5) / bin - 0.5; }

template <class T>
Derivatives derivatives_at(ImagePyramid<T>& pyramid, const DerivativeKernels& kernels, int level, double x,
                           double y) {
  const ImageView<T> image = pyramid.levels[static_cast<std::size_t>(level)];
  const double bin = 1 << level;
  return evaluate_derivatives(
      image, to_phase(std::clamp(in_level(x, 1 << level), 0.0, image.width - 1.0)),
      to_phase(std::clamp(in_level(y, static_cast<int>(bin)), 0.0, image.height - 1.0)), kernels, 0, 0,
      pyramid.border_window);
}

/// Strength of the line near a place at one rung, grey levels / px^2 of the whole image; 0 where there is
/// none.
template <class T>
double strength_at(ImagePyramid<T>& pyramid, KernelCache& cache, double x, double y, int rung) {
  const int level = std::min(ScaleLadder::level(rung), pyramid.count - 1);
  const double bin = 1 << level, per_area = 1 / (bin * bin);
  const DerivativeKernels& kernels = cache.of_rung(rung, level);
  const double noise = pyramid.noise[static_cast<std::size_t>(level)] * kernels.curvature_gain;
  HessianAxes axes;
  // Once more from the ridge, which the seed may miss by about a kernel's width.
  for (int step = 0; step < 2; ++step) {
    const Derivatives d = derivatives_at(pyramid, kernels, level, x, y);
    axes = hessian_axes(d);
    if (axes.across >= 0) return 0;
    if (step == 1) break;
    const double t = std::clamp(ridge_offset(d, axes.normal_x, axes.normal_y, axes.across), -kernels.sigma,
                                kernels.sigma) *
                     bin;
    x += t * axes.normal_x;
    y += t * axes.normal_y;
  }
  const double least = std::max(kClearOfNoise * noise, kFaintestHeight * kernels.matched_strength());
  if (-axes.across < least || std::abs(axes.along) > -kMostAlong * axes.across + kNoisyAlong * noise)
    return 0;
  return -axes.across * per_area;
}

/// Where the parabola through three neighbouring values is largest, relative to the middle one.
double peak_offset(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

/// Mean strength across the known normals of each `step`-th point of a line, normalised. The samples lie as
/// far from one end as from the other.
template <class T>
double line_response(ImagePyramid<T>& pyramid, KernelCache& cache, std::span<const StripePoint> points,
                     std::size_t step, int rung) {
  const int level = std::min(ScaleLadder::level(rung), pyramid.count - 1);
  const double bin = 1 << level;
  const DerivativeKernels& kernels = cache.of_rung(rung, level);
  double sum = 0;
  for (std::size_t i = (points.size() - 1) % step / 2; i < points.size(); i += step) {
    const StripePoint& p = points[i];
    sum -= second_derivative(derivatives_at(pyramid, kernels, level, p.x, p.y), p.normal_x, p.normal_y);
  }
  return sum / (bin * bin) * ScaleLadder::normalisation(rung);
}

}  // namespace

const DerivativeKernels& KernelCache::nearest(double sigma) {
  constexpr double kPerOctave = 8;
  return close_to(std::exp2(std::round(kPerOctave * std::log2(sigma)) / kPerOctave));
}

const DerivativeKernels& KernelCache::close_to(double sigma) {
  constexpr double kPerOctave = 64;
  const auto index = static_cast<int>(std::lround(kPerOctave * std::log2(sigma)));
  const auto found = sets.find(index);
  if (found != sets.end()) return found->second;
  return sets.emplace(index, make_derivative_kernels(std::exp2(index / kPerOctave))).first->second;
}

// Coarse pixels blur by their own width, once in the image and once in the kernel that is integrated over
// them: so much less is left to the kernel.
const DerivativeKernels& KernelCache::of_rung(int rung, int level) {
  const DerivativeKernels*& kept =
      rungs.at(static_cast<std::size_t>(rung)).at(static_cast<std::size_t>(level));
  if (kept != nullptr) return *kept;
  const double bin = 1 << level, sigma = ScaleLadder::sigma(rung);
  const double variance = sigma * sigma - (bin * bin - 1) / 6;
  kept = &close_to(std::sqrt(std::max(variance, 0.5 * sigma * sigma)) / bin);
  return *kept;
}

double ScaleLadder::normalisation(int rung) {
  static const auto values = [] {
    std::array<double, kRungs> v{};
    for (int k = 0; k < kRungs; ++k) v.at(static_cast<std::size_t>(k)) = std::pow(sigma(k), 1.5);
    return v;
  }();
  return values.at(static_cast<std::size_t>(rung));
}
double ScaleLadder::sigma(double rung) { return std::exp2(0.5 * rung); }
int ScaleLadder::level(int rung) { return rung <= 2 ? 0 : (rung - 1) / 2; }

template <class T>
void build_pyramid(ImageView<T> image, double noise, ImagePyramid<T>& pyramid) {
  add_levels(
      image, noise, pyramid, [](ImageView<T> finer, int, Image<T>& coarser) { halve(finer, coarser); },
      [&](ImageView<T> level, int k) {
        // White noise falls by half from level to level; grain, texture and a codec's noise by less.
        const int thinning = std::max(1, static_cast<int>(1.0 * level.width * level.height / kNoisePixels));
        return std::max(noise / (1 << k), estimate_noise(level, thinning).seen);
      });
}

template <class T>
void build_pyramid(ImageView<T> image, const LevelNoise& noise, const SearchWindows& windows,
                   ImagePyramid<T>& pyramid) {
  add_levels(
      image, noise[0], pyramid,
      [&](ImageView<T> finer, int k, Image<T>& coarser) { halve(finer, windows, k, coarser); },
      [&](ImageView<T>, int k) { return noise[static_cast<std::size_t>(k)]; });
}

template <class T>
std::optional<ScaledRidge> best_scale(ImagePyramid<T>& pyramid, KernelCache& kernels, double x, double y,
                                      int first, int last) {
  std::array<double, ScaleLadder::kRungs + 2> normalised{};  // with a 0 at both ends
  double largest = 0;
  int best = -1;
  for (int rung = std::max(first, 0); rung <= std::min(last, ScaleLadder::kRungs - 1); ++rung) {
    const auto k = static_cast<std::size_t>(rung + 1);
    normalised[k] = strength_at(pyramid, kernels, x, y, rung) * ScaleLadder::normalisation(rung);
    largest = std::max(largest, normalised[k]);
  }
  if (largest <= 0) return std::nullopt;
  // A bright core in a wide glow has two maxima: the line is the narrower one.
  for (int rung = 0; rung < ScaleLadder::kRungs && best < 0; ++rung) {
    const auto k = static_cast<std::size_t>(rung + 1);
    if (normalised[k] >= kOwnMaximum * largest && normalised[k] >= normalised[k + 1]) best = rung;
  }
  const auto k = static_cast<std::size_t>(best + 1);
  const bool inside = normalised[k - 1] > 0 && normalised[k + 1] > 0;
  const double offset = inside ? peak_offset(normalised[k - 1], normalised[k], normalised[k + 1]) : 0.0;
  return ScaledRidge{ScaleLadder::sigma(best + offset), normalised[k]};
}

template <class T>
double scale_of_line(ImagePyramid<T>& pyramid, KernelCache& kernels, std::span<const StripePoint> points,
                     double sigma) {
  constexpr int kLast = ScaleLadder::kRungs - 1;
  const std::size_t step =
      std::max({std::size_t{1}, points.size() / kSamples, static_cast<std::size_t>(kSampleSpacing * sigma)});
  std::array<double, ScaleLadder::kRungs> responses{};
  const auto response = [&](int rung) {
    double& r = responses[static_cast<std::size_t>(rung)];
    if (r == 0) r = line_response(pyramid, kernels, points, step, rung);
    return r;
  };
  int rung = std::clamp(static_cast<int>(std::lround(2 * std::log2(sigma))), 0, kLast);
  while (rung > 0 && response(rung - 1) > response(rung)) --rung;
  while (rung < kLast && response(rung + 1) > response(rung)) ++rung;
  if (rung == 0 || rung == kLast) return ScaleLadder::sigma(rung);
  return ScaleLadder::sigma(rung + peak_offset(response(rung - 1), response(rung), response(rung + 1)));
}

double grain_of_line(std::span<const StripePoint> points, double sigma, double noise,
                     std::vector<float>& scratch) {
  constexpr std::size_t kLeast = 24, kEnough = 300;
  constexpr double kClear = 1.5;  // times the noise
  const auto lag = static_cast<std::size_t>(std::lround(std::max(1.0, 2.5 * sigma)));
  if (points.size() < 2 * lag + kLeast) return 0;
  const std::size_t step = 1 + points.size() / kEnough;
  scratch.clear();
  double strength = 0;
  for (std::size_t i = 0; i + 2 * lag < points.size(); i += step) {
    const double middle = points[i + lag].strength;
    scratch.push_back(
        static_cast<float>(std::abs(points[i].strength - 2 * middle + points[i + 2 * lag].strength)));
    strength += middle;
  }
  strength /= static_cast<double>(scratch.size());
  const double seen = kSecondDifferenceToSigma * double{ranked_median(scratch)};
  return seen > kClear * noise ? std::sqrt(seen * seen - noise * noise) / strength : 0.0;
}

template void build_pyramid<std::uint8_t>(ImageView8, double, ImagePyramid<std::uint8_t>&);
template void build_pyramid<std::uint16_t>(ImageView16, double, ImagePyramid<std::uint16_t>&);
template void build_pyramid<std::uint8_t>(ImageView8, const LevelNoise&, const SearchWindows&,
                                          ImagePyramid<std::uint8_t>&);
template void build_pyramid<std::uint16_t>(ImageView16, const LevelNoise&, const SearchWindows&,
                                           ImagePyramid<std::uint16_t>&);
template std::optional<ScaledRidge> best_scale<std::uint8_t>(ImagePyramid<std::uint8_t>&, KernelCache&,
                                                             double, double, int, int);
template std::optional<ScaledRidge> best_scale<std::uint16_t>(ImagePyramid<std::uint16_t>&, KernelCache&,
                                                              double, double, int, int);
template double scale_of_line<std::uint8_t>(ImagePyramid<std::uint8_t>&, KernelCache&,
                                            std::span<const StripePoint>, double);
template double scale_of_line<std::uint16_t>(ImagePyramid<std::uint16_t>&, KernelCache&,
                                             std::span<const StripePoint>, double);

}  // namespace lightstripe
