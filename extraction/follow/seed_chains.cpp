// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/seed_chains.h"

#include <algorithm>
#include <cstddef>

namespace lightstripe {
namespace {

constexpr int kFreeAside = 2;  // cells to both sides of a chain

/// A level's cells, seen along one axis: `along` steps through the cells of a row (or column), `aside` from
/// one row (or column) to the next.
struct CellGrid {
  std::ptrdiff_t along = 1, aside = 1;
  int length = 0, count = 0;
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(i * along + j * aside); }
};

/// Seeds without others close to both of their sides.
void find_lone(const CellGrid& grid, const std::vector<std::uint8_t>& taken,
               std::vector<std::uint8_t>& lone) {
  lone.assign(taken.size(), 0);
  for (int j = 0; j < grid.count; ++j)
    for (int i = 0; i < grid.length; ++i) {
      if (taken[grid.at(i, j)] == 0) continue;
      const bool before = j >= kFreeAside && taken[grid.at(i, j - kFreeAside)] != 0;
      const bool after = j + kFreeAside < grid.count && taken[grid.at(i, j + kFreeAside)] != 0;
      lone[grid.at(i, j)] = before || after ? 0 : 1;
    }
}

/// Of each cell the best chain that ends there and comes from `from` (1: from the beginning, -1: from the
/// end).
void add_up(const CellGrid& grid, const std::vector<std::uint8_t>& lone, int from,
            std::vector<std::int16_t>& sums) {
  sums.assign(lone.size(), 0);
  for (int k = 0; k < grid.length; ++k) {
    const int i = from > 0 ? k : grid.length - 1 - k;
    for (int j = 0; j < grid.count; ++j) {
      int best = 0;
      if (k > 0)
        for (int n = std::max(0, j - 1); n <= std::min(grid.count - 1, j + 1); ++n)
          best = std::max<int>(best, sums[grid.at(i - from, n)]);
      sums[grid.at(i, j)] =
          static_cast<std::int16_t>(std::max(0, best + (lone[grid.at(i, j)] != 0 ? 1 : -1)));
    }
  }
}

/// Sets the lengths of one level's seeds.
void measure_chains(std::span<const ScaleSeed> seeds, int level, int width, int height,
                    SeedChainWorkspace& w) {
  const int shift = level + kTriedCellShift, columns = (width >> shift) + 1, rows = (height >> shift) + 1;
  const auto cell = [&](const ScaleSeed& s) {
    return static_cast<std::size_t>(s.y >> shift) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(s.x >> shift);
  };
  w.taken.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (const ScaleSeed& s : seeds)
    if (s.level == level) w.taken[cell(s)] = 1;
  for (const CellGrid& grid : {CellGrid{1, columns, columns, rows}, CellGrid{columns, 1, rows, columns}}) {
    find_lone(grid, w.taken, w.lone);
    add_up(grid, w.lone, 1, w.forward);
    add_up(grid, w.lone, -1, w.backward);
    for (std::size_t k = 0; k < seeds.size(); ++k) {
      if (seeds[k].level != level || w.lone[cell(seeds[k])] == 0) continue;
      const int cells = w.forward[cell(seeds[k])] + w.backward[cell(seeds[k])] - 1;
      w.length[k] = std::max(w.length[k], cells << shift);
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
