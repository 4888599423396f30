// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Passes over whole rows at memory speed: the brightest level and the places where a line may begin.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/image.h"

namespace lightstripe {

/// The largest of `count` pixels, 0 for none.
std::uint8_t largest_pixel(const std::uint8_t* pixels, std::size_t count);
std::uint16_t largest_pixel(const std::uint16_t* pixels, std::size_t count);

/// Of the whole image, 0 for none.
template <class T>
T largest_pixel(ImageView<T> image) {
  T largest = 0;
  for (int y = 0; y < image.height; ++y)
    largest = std::max(largest, largest_pixel(image.row(y), static_cast<std::size_t>(image.width)));
  return largest;
}

/// Means of 2 x 2 pixels of two rows, rounded: `count` pixels of the coarser one.
void halve_rows(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* out);
void halve_rows(const std::uint16_t* a, const std::uint16_t* b, std::size_t count, std::uint16_t* out);

/// A row and its neighbours `reach` pixels above and below (outside the image: the row of zeros).
template <class T>
struct ScanRow {
  const T* centre = nullptr;
  const T* above = nullptr;
  const T* below = nullptr;
};

/// What makes a pixel a candidate: grey level at least `level`, and by at least `contrast` (> 0) brighter
/// than the pixels at distance `reach` on both sides, left and right or above and below.
template <class T>
struct ScanRule {
  T level = 0;
  T contrast = 1;
  int reach = 1;  ///< px
};

/// Sets bit x % 64 of masks[x / 64] for each candidate with reach <= x < width - reach, and clears all others
/// of the (width + 63) / 64 words. True if there is one. `contrasts`, where it is given: `width` pixels,
/// those of candidates become their contrast, others anything.
bool mark_candidates(const ScanRow<std::uint8_t>& row, int width, const ScanRule<std::uint8_t>& rule,
                     std::uint64_t* masks, std::uint8_t* contrasts = nullptr);
bool mark_candidates(const ScanRow<std::uint16_t>& row, int width, const ScanRule<std::uint16_t>& rule,
                     std::uint64_t* masks, std::uint16_t* contrasts = nullptr);

/// The contrast of one pixel by that rule (the larger of the two directions, each the smaller of its two
/// sides); a side beyond the row's ends does not count.
template <class T>
T candidate_contrast(const ScanRow<T>& row, int x, int width, int reach) {
  const auto excess = [](T a, T b) { return static_cast<T>(a > b ? a - b : 0); };
  const auto smaller = [](T a, T b) { return a < b ? a : b; };
  const T grey = row.centre[x];
  const T left = x >= reach ? excess(grey, row.centre[x - reach]) : grey;
  const T right = x + reach < width ? excess(grey, row.centre[x + reach]) : grey;
  const T across_row = smaller(left, right);
  const T across_column = smaller(excess(grey, row.above[x]), excess(grey, row.below[x]));
  return across_row > across_column ? across_row : across_column;
}

/// The plain reference of mark_candidates.
template <class T>
bool mark_candidates_scalar(const ScanRow<T>& row, int width, const ScanRule<T>& rule, std::uint64_t* masks) {
  for (int word = 0; word < (width + 63) / 64; ++word) masks[word] = 0;
  bool any = false;
  for (int x = rule.reach; x < width - rule.reach; ++x) {
    if (row.centre[x] < rule.level || candidate_contrast(row, x, width, rule.reach) < rule.contrast) continue;
    masks[x / 64] |= std::uint64_t{1} << (x % 64);
    any = true;
  }
  return any;
}

}  // namespace lightstripe
