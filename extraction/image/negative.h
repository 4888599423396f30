// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The image in which dark lines are bright.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/image.h"
#include "extraction/kernels/kernels_scan.h"

namespace lightstripe {

/// The image in which dark lines are bright: each grey value taken from the largest that its kind of pixel
/// has, or, of 16-bit pixels, from the largest of as many bits as the image uses. Colour tells nothing of
/// them.
template <class T>
ImageView<T> inverted(ImageView<T> image, Image<T>& negative) {
  T largest = std::numeric_limits<T>::max();
  if constexpr (sizeof(T) > 1) {
    largest = static_cast<T>(std::bit_ceil(std::uint32_t{largest_pixel(image)} + 1) - 1);
  }
  negative.width = image.width;
  negative.height = image.height;
  negative.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    std::transform(image.row(y), image.row(y) + image.width, negative.row(y),
                   [largest](T grey) { return static_cast<T>(largest - grey); });
  return negative.view();
}

/// The grey level at which pixels are clipped: of 16-bit pixels nobody knows it, but the brightest one fills
/// at least half of the range.
template <class T>
double full_scale_of(ImageView<T>, double brightest) {
  if constexpr (sizeof(T) == 1) return std::numeric_limits<T>::max();
  return std::max(1023.0, std::exp2(std::ceil(std::log2(brightest + 1))) - 1);
}

}  // namespace lightstripe
