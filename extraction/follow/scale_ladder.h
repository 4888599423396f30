// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One image at several scales: how wide is the line at this place? Lindeberg, "Edge detection and ridge
// detection with automatic scale selection", IJCV 30 (1998), section 5.6: the ridge strength normalised with
// gamma = 3/4, t^(3/4) |L_pp| with t = sigma^2, is largest where sigma is the line's own standard deviation.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/image.h"
#include "core/stripe.h"
#include "extraction/kernels/kernels.h"
#include "extraction/track/search_windows.h"

namespace lightstripe {

/// The ladder of scales: half an octave from rung to rung.
struct ScaleLadder {
  static constexpr int kRungs = 9;
  static double sigma(double rung);       ///< px, 1 ... 16; rungs may be broken
  static double normalisation(int rung);  ///< sigma^1.5
  static int level(int rung);  ///< the pyramid's, in which the rung's kernels are 1.4 or 2 pixels wide
};

/// Kernels of the scales met so far, kept from frame to frame.
struct KernelCache {
  static constexpr int kMostLevels = 4;  ///< of a pyramid

  std::map<int, DerivativeKernels> sets;
  /// Those of the ladder's rungs in each level, null until they are asked for; they point into `sets`.
  std::array<std::array<const DerivativeKernels*, kMostLevels>, ScaleLadder::kRungs> rungs{};

  KernelCache() = default;
  KernelCache(const KernelCache&) = delete;
  KernelCache& operator=(const KernelCache&) = delete;
  KernelCache(KernelCache&&) = default;
  KernelCache& operator=(KernelCache&&) = default;
  ~KernelCache() = default;

  /// The kernels nearest to `sigma` px of eight scales an octave, so that they are few.
  const DerivativeKernels& nearest(double sigma);
  /// Those within 0.5 % of `sigma`.
  const DerivativeKernels& close_to(double sigma);
  /// Those of one rung of the ladder in a level of the pyramid.
  const DerivativeKernels& of_rung(int rung, int level);
};

/// The image, and means of 2 x 2, 4 x 4 and 8 x 8 of its pixels: there broad kernels cost as little as narrow
/// ones.
template <class T>
struct ImagePyramid {
  static constexpr int kMostLevels = KernelCache::kMostLevels;

  std::array<ImageView<T>, kMostLevels> levels;
  std::array<double, kMostLevels> noise{};  ///< grey levels, as it is seen in each level
  std::array<Image<T>, kMostLevels - 1> binned;
  std::vector<T> border_window;
  int count = 0;
};

/// `noise`: of the image, grey levels. Small images have fewer levels.
template <class T>
void build_pyramid(ImageView<T> image, double noise, ImagePyramid<T>& pyramid);

/// Noise in each level of a pyramid, grey levels.
using LevelNoise = std::array<double, ImagePyramid<std::uint8_t>::kMostLevels>;

/// The same where only the windows are looked at: black elsewhere in the binned levels, and the levels' noise
/// is given.
template <class T>
void build_pyramid(ImageView<T> image, const LevelNoise& noise, const SearchWindows& windows,
                   ImagePyramid<T>& pyramid);

/// A ridge at the scale that suits it best.
struct ScaledRidge {
  double sigma = 0;       ///< px
  double normalised = 0;  ///< sigma^1.5 times the strength
};

/// The best of the rungs from `first` to `last` near (x, y), px. Nothing where no rung shows a bright line
/// that stands clear of the noise and is longer than wide.
template <class T>
std::optional<ScaledRidge> best_scale(ImagePyramid<T>& pyramid, KernelCache& kernels, double x, double y,
                                      int first, int last);

/// The scale at which the points of a line, found at `sigma` px, are strongest on average; px.
template <class T>
double scale_of_line(ImagePyramid<T>& pyramid, KernelCache& kernels, std::span<const StripePoint> points,
                     double sigma);

/// How much the strength of a line varies from grain to grain, as a share of the strength, beyond what the
/// camera's noise does: the median of second differences over 2.5 `sigma`, which squares of a board and
/// slow changes do not touch. 0 where it does not stand out of `noise`, the standard deviation of strengths.
double grain_of_line(std::span<const StripePoint> points, double sigma, double noise,
                     std::vector<float>& scratch);

}  // namespace lightstripe
