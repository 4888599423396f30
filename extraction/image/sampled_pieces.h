// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A part of an image that stands for the whole: short pieces of every row, staggered from row to row.
#pragma once

#include <algorithm>

#include "core/image.h"

namespace lightstripe {

/// Calls work(first pixel, length) for one in `thinning` pieces of 32 pixels (fewer at the end of a row).
/// Whole rows would hit or miss a stripe that runs along them; such pieces meet every stripe in proportion.
template <class T, class Work>
void for_sampled_pieces(ImageView<T> image, int thinning, const Work& work) {
  constexpr int kPiece = 32;
  const int pieces = (image.width + kPiece - 1) / kPiece;
  // The golden section spreads the offsets of neighbouring rows.
  const int stagger = std::max(1, static_cast<int>(0.618 * thinning));
  for (int y = 0, offset = 0; y < image.height; ++y, offset = (offset + stagger) % thinning)
    for (int piece = offset; piece < pieces; piece += thinning)
      work(image.row(y) + piece * kPiece, std::min(kPiece, image.width - piece * kPiece));
}

}  // namespace lightstripe
