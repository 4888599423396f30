// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Grey-level statistics: histogram, Otsu's and Rosin's thresholds, and the bilevel thresholds of
// Chen, Zhang, Sun, Adv. Mech. Eng. 2013, 456927, section 3.1.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"

namespace lightstripe {

/// Counts of grey levels; a bin holds `bin_width` neighbouring levels (1 for 8-bit images).
struct Histogram {
  static constexpr int kBins = 256;
  std::array<std::uint32_t, kBins> counts{};
  double bin_width = 1;  ///< grey levels
  double largest = 0;    ///< grey level: the brightest pixel of the whole image
  std::uint64_t total = 0;
};

/// Counts about one pixel in `thinning`, spread evenly over the image; the brightest level is taken from all
/// pixels.
template <class T>
Histogram compute_histogram(ImageView<T> image, int thinning = 1);

/// The same where the brightest level is known but for the counted pixels: nothing else is read.
template <class T>
Histogram compute_histogram(ImageView<T> image, int thinning, double largest);

/// Bin that maximises the variance between the classes [0, bin] and [bin + 1, 255] (Otsu 1979).
int otsu_threshold(const Histogram& histogram);

/// Corner of a unimodal histogram: the bin farthest below the straight line from the highest peak to the last
/// used bin (Rosin 2001). The peak's bin if that is the last one.
int rosin_threshold(const Histogram& histogram);

/// E = -sum p_i log2 p_i over the grey levels, bits.
double histogram_entropy(const Histogram& histogram);

/// Peaks of the smoothed histogram that hold a visible share of the pixels.
int count_histogram_peaks(const Histogram& histogram);

struct ThresholdOptions {
  std::optional<double> alpha;    ///< weight of T_min in T_l; not given: from entropy and peaks
  double beta = 0;                ///< weight of T_max in T_h
  double entropy_limit = 4.5;     ///< bits; above it, and with more than two peaks, light disturbs
  double disturbed_alpha = 0.75;  ///< the paper's choice for its image with reflections
};

/// All that decides the bilevel thresholds; grey levels.
struct BilevelThresholds {
  double t_min = 0;  ///< the histogram's highest peak: the background
  double t_max = 0;  ///< the brightest level
  double t_rosin = 0;
  double t_otsu = 0;
  double entropy = 0;  ///< bits
  int peaks = 0;
  double alpha = 0;
  double low = 0;   ///< T_l: background below it
  double high = 0;  ///< T_h: foreground above it
};

/// T_l = a T_min + (1-a) min(T_rosin, T_otsu), T_h = b T_max + (1-b) max(T_rosin, T_otsu).
BilevelThresholds compute_bilevel_thresholds(const Histogram& histogram,
                                             const ThresholdOptions& options = {});

}  // namespace lightstripe
