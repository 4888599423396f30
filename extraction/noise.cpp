// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace lightstripe {
namespace {

constexpr int kBins = 4096;  // larger differences are edges, not noise

struct DifferenceCounts {
  std::array<std::uint32_t, kBins> counts{};
  std::uint64_t total = 0;    ///< triples without a clipped pixel
  std::uint64_t clipped = 0;  ///< triples with one
};

template <class T>
void count_differences(const T* row, int width, DifferenceCounts& c) {
  for (int x = 1; x + 1 < width; ++x) {
    const int left = row[x - 1], centre = row[x], right = row[x + 1];
    if (left == 0 || centre == 0 || right == 0) {
      ++c.clipped;
      continue;
    }
    ++c.counts[static_cast<std::size_t>(std::min(std::abs(left - 2 * centre + right), kBins - 1))];
    ++c.total;
  }
}

/// Median of the absolute differences; a bin k stands for magnitudes within half a level of k.
double median_difference(const DifferenceCounts& c) {
  const double half = 0.5 * static_cast<double>(c.total);
  double below = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double count = c.counts[static_cast<std::size_t>(bin)];
    if (below + count < half || count == 0) {
      below += count;
      continue;
    }
    const double low = bin == 0 ? 0.0 : bin - 0.5;
    return low + (half - below) / count * (bin + 0.5 - low);
  }
  return 0;
}

}  // namespace

template <class T>
double estimate_noise(ImageView<T> image, int row_step) {
  constexpr double kQuantisation = 0.28867513459481287;  // 1 / sqrt(12)
  constexpr double kMedianToSigma =
      1.4826 / 2.449489743;               // of a normal; second differences have sqrt(6) sigma
  constexpr double kHalfNormal = 0.6028;  // standard deviation of a halved normal of sigma 1
  DifferenceCounts c;
  for (int y = row_step / 2; y < image.height; y += row_step) count_differences(image.row(y), image.width, c);
  if (c.total == 0) return kQuantisation;
  const double sigma = median_difference(c) * kMedianToSigma;
  const bool clipped = c.clipped > c.total;
  return std::max(kQuantisation, clipped ? sigma / kHalfNormal : sigma);
}

template double estimate_noise<std::uint8_t>(ImageView8, int);
template double estimate_noise<std::uint16_t>(ImageView16, int);

}  // namespace lightstripe
