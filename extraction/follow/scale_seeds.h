// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where lines may begin in an image at several scales.
#pragma once

#include <cstdint>
#include <vector>

#include "extraction/follow/line_seeds.h"
#include "extraction/follow/scale_ladder.h"

namespace lightstripe {

/// A place where a line may begin.
struct ScaleSeed {
  std::int32_t x = 0, y = 0;  ///< px
  std::int16_t level = 0;     ///< of the pyramid, where it stands out
  std::int16_t rank = 0;      ///< contrast, 0..255 of the brightest pixel
};

/// What is known of the image.
struct ScaleSeedRule {
  double brightest = 0;                    ///< grey level
  const SearchWindows* windows = nullptr;  ///< nothing else is looked at; null: everything
};

/// Appends those of one level of the pyramid, in reading order. None where another light than the laser's is.
template <class T>
void collect_scale_seeds(const ImagePyramid<T>& pyramid, int level, const ScaleSeedRule& rule,
                         SeedWorkspace& workspace, std::vector<ScaleSeed>& found);

/// By falling contrast; equals keep their order.
void sort_by_contrast(const std::vector<ScaleSeed>& found, std::vector<ScaleSeed>& sorted);

/// Of each cell of 4 x 4 px of a level one place is tried.
inline constexpr int kTriedCellShift = 2;

/// Rungs of the ladder that a seed of one level may belong to: those of its own level and the next ones.
struct RungRange {
  int first, last;
};
inline RungRange rungs_of(int level) { return {2 * level - 2, 2 * level + 4}; }

}  // namespace lightstripe
