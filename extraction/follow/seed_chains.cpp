// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/seed_chains.h"

#include <algorithm>
#include <cstddef>

namespace lightstripe {
namespace {

constexpr int kFreeAside = 2;  // cells to both sides of a chain

/// A level's cells, seen along one axis: cells beside each other across it lie beside each other in memory,
/// with free ones at both ends, so that a step along the axis is one pass of vectors.
struct CellGrid {
  int shift = 0;  ///< px to cells
  bool along_rows = true;
  int length = 0, count = 0;  ///< cells along the axis, and across it
  std::size_t pitch() const { return static_cast<std::size_t>(count + 2 * kFreeAside); }
  std::size_t at(const ScaleSeed& s) const {
    const int along = (along_rows ? s.x : s.y) >> shift, across = (along_rows ? s.y : s.x) >> shift;
    return static_cast<std::size_t>(along) * pitch() + static_cast<std::size_t>(across + kFreeAside);
  }
  std::size_t size() const { return static_cast<std::size_t>(length) * pitch(); }
};

/// What a cell adds to a chain: 1 with a seed and none close to both of its sides, else -1.
void find_gains(const std::vector<std::uint8_t>& taken, std::vector<std::int16_t>& gains) {
  gains.assign(taken.size(), -1);
  for (std::size_t k = kFreeAside; k + kFreeAside < taken.size(); ++k) {
    const bool lone = taken[k] != 0 && (taken[k - kFreeAside] | taken[k + kFreeAside]) == 0;
    gains[k] = lone ? std::int16_t{1} : std::int16_t{-1};
  }
}

/// Of each cell the best chain that ends there and comes from the beginning, or from the end.
void add_up(const CellGrid& grid, const std::vector<std::int16_t>& gains, bool from_end,
            std::vector<std::int16_t>& sums) {
  sums.assign(gains.size(), 0);
  const std::size_t pitch = grid.pitch(), last = static_cast<std::size_t>(grid.length - 1);
  const std::vector<std::int16_t> none(pitch, 0);
  const std::int16_t* before = none.data();
  for (std::size_t k = 0; k <= last; ++k) {
    const std::size_t row = (from_end ? last - k : k) * pitch;
    std::int16_t* sum = sums.data() + row;
    const std::int16_t* gain = gains.data() + row;
    for (std::size_t j = kFreeAside; j + kFreeAside < pitch; ++j) {
      const std::int16_t best = std::max(std::max(before[j - 1], before[j + 1]), before[j]);
      sum[j] = std::max<std::int16_t>(0, static_cast<std::int16_t>(best + gain[j]));
    }
    before = sum;
  }
}

/// Sets the lengths of one level's seeds.
void measure_chains(std::span<const ScaleSeed> seeds, int level, int width, int height,
                    SeedChainWorkspace& w) {
  const int shift = level + kTriedCellShift, columns = (width >> shift) + 1, rows = (height >> shift) + 1;
  for (const CellGrid& grid : {CellGrid{shift, true, columns, rows}, CellGrid{shift, false, rows, columns}}) {
    w.taken.assign(grid.size(), 0);
    for (const ScaleSeed& s : seeds)
      if (s.level == level) w.taken[grid.at(s)] = 1;
    find_gains(w.taken, w.gains);
    add_up(grid, w.gains, false, w.forward);
    add_up(grid, w.gains, true, w.backward);
    for (std::size_t k = 0; k < seeds.size(); ++k) {
      if (seeds[k].level != level) continue;
      const std::size_t cell = grid.at(seeds[k]);
      if (w.gains[cell] > 0)
        w.length[k] = std::max(w.length[k], (w.forward[cell] + w.backward[cell] - 1) << shift);
    }
  }
}

}  // namespace

void collect_chained_seeds(std::span<const ScaleSeed> seeds, int width, int height, int least_length,
                           SeedChainWorkspace& workspace, std::vector<ScaleSeed>& chained) {
  workspace.length.assign(seeds.size(), 0);
  for (int level = 0; level < KernelCache::kMostLevels; ++level)
    if (std::any_of(seeds.begin(), seeds.end(), [&](const ScaleSeed& s) { return s.level == level; }))
      measure_chains(seeds, level, width, height, workspace);
  chained.clear();
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < seeds.size(); ++k)
    if (workspace.length[k] >= least_length) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return workspace.length[a] > workspace.length[b]; });
  for (const std::size_t k : order) chained.push_back(seeds[k]);
}

}  // namespace lightstripe
