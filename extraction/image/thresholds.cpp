// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/thresholds.h"

#include <algorithm>
#include <cmath>

#include "extraction/image/sampled_pieces.h"
#include "extraction/kernels/kernels_scan.h"

namespace lightstripe {
namespace {

constexpr int kBins = Histogram::kBins;

int highest_peak(const Histogram& h) {
  return static_cast<int>(std::max_element(h.counts.begin(), h.counts.end()) - h.counts.begin());
}

int last_used_bin(const Histogram& h) {
  for (int bin = kBins - 1; bin > 0; --bin)
    if (h.counts[static_cast<std::size_t>(bin)] > 0) return bin;
  return 0;
}

/// The grey level in the middle of a bin.
double level_of(const Histogram& h, int bin) { return (bin + 0.5) * h.bin_width - 0.5; }

/// Moving mean over 2 * reach + 1 bins.
std::array<double, kBins> smoothed(const Histogram& h, int reach) {
  std::array<double, kBins> mean{};
  for (int bin = 0; bin < kBins; ++bin) {
    double sum = 0;
    const int first = std::max(0, bin - reach), last = std::min(kBins - 1, bin + reach);
    for (int k = first; k <= last; ++k) sum += h.counts[static_cast<std::size_t>(k)];
    mean[static_cast<std::size_t>(bin)] = sum / (last - first + 1);
  }
  return mean;
}

template <class T>
Histogram count_levels(ImageView<T> image, int thinning, double largest) {
  Histogram h;
  if (image.empty()) return h;
  h.largest = largest;
  int shift = 0;
  while ((static_cast<int>(h.largest) >> shift) >= kBins) ++shift;
  h.bin_width = 1 << shift;
  // Two tables, because neighbouring pixels are often equal and would wait for each other's increment.
  std::array<std::uint32_t, kBins> even{}, odd{};
  const auto count = [&](const T* pixels, int length) {
    int x = 0;
    for (; x + 1 < length; x += 2) {
      ++even[static_cast<std::size_t>(pixels[x] >> shift)];
      ++odd[static_cast<std::size_t>(pixels[x + 1] >> shift)];
    }
    if (x < length) ++even[static_cast<std::size_t>(pixels[x] >> shift)];
    h.total += static_cast<std::uint64_t>(length);
  };
  for_sampled_pieces(image, thinning, count);
  for (std::size_t bin = 0; bin < kBins; ++bin) h.counts[bin] = even[bin] + odd[bin];
  return h;
}

}  // namespace

template <class T>
Histogram compute_histogram(ImageView<T> image, int thinning) {
  return count_levels(image, thinning, largest_pixel(image));
}

template <class T>
Histogram compute_histogram(ImageView<T> image, int thinning, double largest) {
  for_sampled_pieces(image, thinning, [&](const T* pixels, int length) {
    largest = std::max<double>(largest, largest_pixel(pixels, static_cast<std::size_t>(length)));
  });
  return count_levels(image, thinning, largest);
}

template Histogram compute_histogram<std::uint8_t>(ImageView8, int);
template Histogram compute_histogram<std::uint16_t>(ImageView16, int);
template Histogram compute_histogram<std::uint8_t>(ImageView8, int, double);
template Histogram compute_histogram<std::uint16_t>(ImageView16, int, double);

int otsu_threshold(const Histogram& histogram) {
  double total = 0, total_sum = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double count = histogram.counts[static_cast<std::size_t>(bin)];
    total += count;
    total_sum += count * bin;
  }
  double weight = 0, sum = 0, best = -1;
  int threshold = 0;
  for (int bin = 0; bin < kBins - 1; ++bin) {
    const double count = histogram.counts[static_cast<std::size_t>(bin)];
    weight += count;
    sum += count * bin;
    if (weight == 0 || weight == total) continue;
    const double difference = sum / weight - (total_sum - sum) / (total - weight);
    const double between = weight * (total - weight) * difference * difference;
    if (between > best) {
      best = between;
      threshold = bin;
    }
  }
  return threshold;
}

int rosin_threshold(const Histogram& histogram) {
  const int peak = highest_peak(histogram), last = last_used_bin(histogram);
  if (last <= peak) return peak;
  const double top = histogram.counts[static_cast<std::size_t>(peak)];
  const double slope = (histogram.counts[static_cast<std::size_t>(last)] - top) / (last - peak);
  double best = 0;
  int corner = peak;
  for (int bin = peak; bin <= last; ++bin) {
    // The vertical distance to the line; the perpendicular one is a constant factor smaller.
    const double below = top + slope * (bin - peak) - histogram.counts[static_cast<std::size_t>(bin)];
    if (below > best) {
      best = below;
      corner = bin;
    }
  }
  return corner;
}

double histogram_entropy(const Histogram& histogram) {
  double entropy = 0;
  for (const std::uint32_t count : histogram.counts) {
    if (count == 0) continue;
    const double p = count / static_cast<double>(histogram.total);
    entropy -= p * std::log2(p);
  }
  return entropy;
}

int count_histogram_peaks(const Histogram& histogram) {
  const auto mean = smoothed(histogram, 3);
  const double least = 2e-4 * static_cast<double>(histogram.total);
  int peaks = 0;
  double valley = 0, top = 0;
  bool rising = true;
  // A peak counts when the histogram falls to half of it afterwards, and it stood twice above the valley
  // before.
  for (const double value : mean) {
    if (rising) {
      top = std::max(top, value);
      if (value > 0.5 * top) continue;
      if (top > least) ++peaks;
      valley = value;
      rising = false;
    } else {
      valley = std::min(valley, value);
      if (value < 2.0 * valley || value < least) continue;
      top = value;
      rising = true;
    }
  }
  return peaks + (rising && top > least ? 1 : 0);
}

BilevelThresholds compute_bilevel_thresholds(const Histogram& histogram, const ThresholdOptions& options) {
  BilevelThresholds t;
  if (histogram.total == 0) return t;
  t.t_min = level_of(histogram, highest_peak(histogram));
  t.t_max = histogram.largest;
  t.t_rosin = level_of(histogram, rosin_threshold(histogram));
  t.t_otsu = level_of(histogram, otsu_threshold(histogram));
  t.entropy = histogram_entropy(histogram);
  t.peaks = count_histogram_peaks(histogram);
  const bool disturbed = t.entropy > options.entropy_limit && t.peaks > 2;
  t.alpha = options.alpha.value_or(disturbed ? options.disturbed_alpha : 0.0);
  t.low = t.alpha * t.t_min + (1 - t.alpha) * std::min(t.t_rosin, t.t_otsu);
  t.high = options.beta * t.t_max + (1 - options.beta) * std::max(t.t_rosin, t.t_otsu);
  return t;
}

}  // namespace lightstripe
