// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where lines may begin: pixels that stand out over both sides of a stripe (the paper's step 2, its search).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "extraction/track/search_windows.h"

namespace lightstripe {

/// One place where a line may begin.
struct LineSeed {
  std::int32_t x = 0, y = 0;
  std::int32_t rank = 0;  ///< contrast, 0..255 of the strongest
  bool foreground = false;
};

struct SeedRule {
  double level = 0;       ///< grey levels: nothing begins below it
  double foreground = 0;  ///< grey levels: lines begin here first
  double contrast = 1;    ///< grey levels over the surroundings
  double sigma = 1;       ///< px, the stripes' scale
  double brightest = 1;   ///< the image's largest grey level
  int reach = 0;          ///< px to the surroundings on both sides; 0: as suits `sigma`
  int step = 0;           ///< rows and columns between those that are searched; 0: as suits `sigma`
  int cell_shift = 0;     ///< only the strongest of each cell of 2^cell_shift rows and columns; 0: all
  const SearchWindows* windows = nullptr;  ///< nothing else is looked at; null: everything
  int binned = 0;  ///< 2^binned pixels of the windows and of `where` are one of the image that is searched
  const std::uint8_t* where = nullptr;  ///< nothing begins where it is LaserPlace::kNone; null: everywhere
  std::ptrdiff_t where_stride = 0;      ///< of the unbinned image's rows
};

struct SeedWorkspace {
  std::vector<LineSeed> found, sorted;
  std::vector<std::uint64_t> candidate_masks;
  std::vector<ColumnSpan> coloured;    ///< of one row
  std::vector<std::uint32_t> in_cell;  ///< of one row of cells: the place in `found` and one more; 0: none
  std::vector<std::uint8_t> zeros8, contrasts8;  ///< of one row
  std::vector<std::uint16_t> zeros16, contrasts16;
};

/// The candidates of every few rows in `workspace.found`, in reading order.
template <class T>
void collect_seeds(ImageView<T> image, const SeedRule& rule, SeedWorkspace& workspace);

/// The candidates of every few rows in `workspace.sorted`: foreground before undecided pixels, then by
/// falling contrast, then in reading order. Of a wide stripe only every few pixels are taken.
template <class T>
void find_seeds(ImageView<T> image, const SeedRule& rule, SeedWorkspace& workspace);

}  // namespace lightstripe
