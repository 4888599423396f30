// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/scale_seeds.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace lightstripe {
namespace {

/// Pixels that stand out over those 4 px to both sides, which meets stripes of a standard deviation of 1 to
/// 2.5 px of a level.
constexpr int kSeedReach = 4;
/// Grey levels, in the image itself: what stands out by less is no stripe; in means of more pixels less is.
constexpr double kLeastContrast = 4;
/// Standard deviations of the level's noise.
constexpr double kSeedOverNoise = 5;

}  // namespace

template <class T>
void collect_scale_seeds(const ImagePyramid<T>& pyramid, int level, const ScaleSeedRule& rule,
                         SeedWorkspace& workspace, std::vector<ScaleSeed>& found) {
  const auto k = static_cast<std::size_t>(level);
  SeedRule of_level;
  of_level.contrast = std::max(kLeastContrast / (1 << level), kSeedOverNoise * pyramid.noise[k]);
  of_level.foreground = rule.brightest + 1;
  of_level.brightest = rule.brightest;
  of_level.reach = kSeedReach;
  of_level.step = level == 0 ? 2 : 1;
  of_level.cell_shift = kTriedCellShift;
  of_level.windows = rule.windows;
  of_level.binned = level;
  const ImageView<T> image = pyramid.levels[0];
  of_level.where = image.where;
  of_level.where_stride = image.stride;
  collect_seeds(pyramid.levels[k], of_level, workspace);
  const int half = (1 << level) / 2;
  for (const LineSeed& s : workspace.found) {
    const int x = (s.x << level) + half, y = (s.y << level) + half;
    found.push_back({x, y, static_cast<std::int16_t>(level), static_cast<std::int16_t>(s.rank)});
  }
}

void sort_by_contrast(const std::vector<ScaleSeed>& found, std::vector<ScaleSeed>& sorted) {
  std::array<std::size_t, 257> first{};  // a counting sort
  const auto place = [](const ScaleSeed& s) { return static_cast<std::size_t>(255 - s.rank); };
  for (const ScaleSeed& s : found) ++first[place(s) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  sorted.resize(found.size());
  for (const ScaleSeed& s : found) sorted[first[place(s)]++] = s;
}

template void collect_scale_seeds<std::uint8_t>(const ImagePyramid<std::uint8_t>&, int, const ScaleSeedRule&,
                                                SeedWorkspace&, std::vector<ScaleSeed>&);
template void collect_scale_seeds<std::uint16_t>(const ImagePyramid<std::uint16_t>&, int,
                                                 const ScaleSeedRule&, SeedWorkspace&,
                                                 std::vector<ScaleSeed>&);

}  // namespace lightstripe
