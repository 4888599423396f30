// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/noise.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

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
  using Table = std::array<std::uint32_t, kBins + 1>;
  /// Two tables, because neighbouring differences are often equal and would wait for each other's increment;
  /// each begins with the triples that have a clipped pixel.
  Table even{}, odd{};
  std::uint64_t total = 0;  ///< triples
  std::uint64_t clipped() const { return std::uint64_t{even[0]} + odd[0]; }
  std::uint64_t unclipped() const { return total - clipped(); }

  static int bin(int difference) {
    return difference < kFine ? difference : kFine + (difference - kFine) / kCoarse;
  }
  /// Where a bin begins; differences are whole numbers, so that k stands for k - 0.5 ... k + 0.5.
  static double begin(int bin) {
    if (bin == 0) return 0;
    return (bin < kFine ? bin : kFine + (bin - kFine) * kCoarse) - 0.5;
  }
};

/// Second differences of `count` triples, the first of which begins at `at`; -1 where a pixel is clipped.
/// Plain enough for the compiler to make vectors of it.
template <class T, class Difference>
void take_differences(const T* at, int count, Difference* out) {
  for (int k = 0; k < count; ++k) {
    const Difference left = at[k], centre = at[k + 1], right = at[k + 2];
    const auto difference = static_cast<Difference>(left + right - 2 * centre);
    const Difference magnitude = difference < 0 ? static_cast<Difference>(-difference) : difference;
    const Difference least = std::min(left, std::min(centre, right));
    out[k] = least == 0 ? Difference{-1} : magnitude;
  }
}

template <class T>
void count_differences(const T* pixels, int length, DifferenceCounts<T>& c) {
  constexpr int kChunk = 32;
  using Difference = std::conditional_t<sizeof(T) == 1, std::int16_t, std::int32_t>;
  std::array<Difference, kChunk> differences{};
  for (int first = 0; first + 2 < length; first += kChunk) {
    const int count = std::min(kChunk, length - 2 - first);
    take_differences(pixels + first, count, differences.data());
    for (int k = 0; k < count; ++k) {
      auto& table = k % 2 == 0 ? c.even : c.odd;
      ++table[static_cast<std::size_t>(1 +
                                       DifferenceCounts<T>::bin(differences[static_cast<std::size_t>(k)]))];
    }
  }
  if (length > 2) c.total += static_cast<std::uint64_t>(length - 2);
}

template <class T>
double median_difference(const DifferenceCounts<T>& c) {
  const double half = 0.5 * static_cast<double>(c.unclipped());
  double below = 0;
  for (int bin = 0; bin < DifferenceCounts<T>::kBins; ++bin) {
    const auto k = static_cast<std::size_t>(bin + 1);
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
  if (c.unclipped() == 0) return {kQuantisation, kQuantisation};
  const double sigma = median_difference(c) * kSecondDifferenceToSigma;
  const bool is_half = c.clipped() > c.unclipped();
  const double full = is_half ? sigma / kHalfNormal : sigma;
  const double seen = is_half ? full * kClippedNormal : full;
  return {std::max(kQuantisation, seen), std::max(kQuantisation, full)};
}

template NoiseEstimate estimate_noise<std::uint8_t>(ImageView8, int);
template NoiseEstimate estimate_noise<std::uint16_t>(ImageView16, int);

}  // namespace lightstripe
