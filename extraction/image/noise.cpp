// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/noise.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "core/robust.h"
#include "extraction/image/sampled_pieces.h"

namespace lightstripe {
namespace {

/// Counts of absolute differences: single levels at first, coarser ones for the large differences of 16-bit
/// images.
template <class T>
struct DifferenceCounts {
  static constexpr int kFine = sizeof(T) == 1 ? 512 : 2048, kCoarse = 64,
                       kBins = sizeof(T) == 1 ? kFine : 2 * kFine;
  using Table = std::array<std::uint32_t, kBins>;
  /// Two tables, because neighbouring differences are often equal and would wait for each other's increment.
  Table even{}, odd{};
  std::uint64_t total = 0;    ///< triples without a clipped pixel
  std::uint64_t clipped = 0;  ///< triples with one

  static int bin(int difference) {
    return difference < kFine ? difference : kFine + (difference - kFine) / kCoarse;
  }
  /// Where a bin begins; differences are whole numbers, so that k stands for k - 0.5 ... k + 0.5.
  static double begin(int bin) {
    if (bin == 0) return 0;
    return (bin < kFine ? bin : kFine + (bin - kFine) * kCoarse) - 0.5;
  }
};

template <class T>
void count_differences(const T* pixels, int length, DifferenceCounts<T>& c) {
  const auto count = [&](int x, auto& table) {
    const int left = pixels[x - 1], centre = pixels[x], right = pixels[x + 1];
    const bool clipped = left == 0 || centre == 0 || right == 0;
    c.clipped += clipped ? 1U : 0U;
    table[static_cast<std::size_t>(DifferenceCounts<T>::bin(std::abs(left - 2 * centre + right)))] +=
        clipped ? 0U : 1U;
  };
  int x = 1;
  for (; x + 2 < length; x += 2) {
    count(x, c.even);
    count(x + 1, c.odd);
  }
  if (x + 1 < length) count(x, c.even);
  if (length > 2) c.total += static_cast<std::uint64_t>(length - 2);
}

template <class T>
double median_difference(const DifferenceCounts<T>& c) {
  const double half = 0.5 * static_cast<double>(c.total);
  double below = 0;
  for (int bin = 0; bin < DifferenceCounts<T>::kBins; ++bin) {
    const auto k = static_cast<std::size_t>(bin);
    const double count = c.even[k] + c.odd[k];
    if (count > 0 && below + count >= half) {
      const double begin = DifferenceCounts<T>::begin(bin), end = DifferenceCounts<T>::begin(bin + 1);
      return begin + (half - below) / count * (end - begin);
    }
    below += count;
  }
  return 0;
}

}  // namespace

template <class T>
NoiseEstimate estimate_noise(ImageView<T> image, int thinning) {
  constexpr double kQuantisation = 0.28867513459481287;  // 1 / sqrt(12)
  constexpr double kHalfNormal = 0.6028;                 // standard deviation of a halved normal of sigma 1
  constexpr double kClippedNormal = 0.5838;              // the same with the other half at 0
  DifferenceCounts<T> c;
  for_sampled_pieces(image, thinning,
                     [&](const T* pixels, int length) { count_differences(pixels, length, c); });
  c.total -= c.clipped;
  if (c.total == 0) return {kQuantisation, kQuantisation};
  const double sigma = median_difference(c) * kSecondDifferenceToSigma;
  const double full = c.clipped > c.total ? sigma / kHalfNormal : sigma;
  const double seen = c.clipped > c.total ? full * kClippedNormal : full;
  return {std::max(kQuantisation, seen), std::max(kQuantisation, full)};
}

template NoiseEstimate estimate_noise<std::uint8_t>(ImageView8, int);
template NoiseEstimate estimate_noise<std::uint16_t>(ImageView16, int);

}  // namespace lightstripe
