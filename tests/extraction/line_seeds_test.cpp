// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/line_seeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lightstripe {
namespace {

Image8 two_stripes() {  // along y at x = 60.4 (peak 150) and x = 140.2 (peak 60)
  Image8 image(200, 150, 20);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image(x, y) =
          static_cast<std::uint8_t>(std::lround(20 + 150 * std::exp(-0.5 * std::pow((x - 60.4) / 2, 2)) +
                                                60 * std::exp(-0.5 * std::pow((x - 140.2) / 2, 2))));
  return image;
}

SeedRule rule() {
  SeedRule r;
  r.level = 35, r.foreground = 120, r.contrast = 20, r.sigma = 2, r.brightest = 170;
  return r;
}

TEST(LineSeeds, TheBrightLineComesFirstAndAllLieOnALine) {
  SeedWorkspace workspace;
  find_seeds(two_stripes().view(), rule(), workspace);
  ASSERT_GT(workspace.sorted.size(), 10u);
  EXPECT_TRUE(workspace.sorted.front().foreground);
  EXPECT_NEAR(workspace.sorted.front().x, 60, 2);
  bool faint = false;
  for (const LineSeed& seed : workspace.sorted) {
    EXPECT_TRUE(std::abs(seed.x - 60.4) < 5 || std::abs(seed.x - 140.2) < 5) << seed.x;
    faint = faint || seed.x > 100;
  }
  EXPECT_TRUE(faint);
  for (std::size_t i = 1; i < workspace.sorted.size(); ++i) {
    const auto &a = workspace.sorted[i - 1], &b = workspace.sorted[i];
    EXPECT_TRUE(a.foreground > b.foreground || (a.foreground == b.foreground && a.rank >= b.rank));
  }
}

TEST(LineSeeds, OfEachCellOnlyTheStrongestIsLeft) {
  SeedWorkspace all, strongest;
  SeedRule of_cells = rule();
  of_cells.cell_shift = 2;
  collect_seeds(two_stripes().view(), rule(), all);
  collect_seeds(two_stripes().view(), of_cells, strongest);
  std::map<std::pair<int, int>, int> ranks;
  for (const LineSeed& seed : all.found) {
    int& rank = ranks[{seed.x / 4, seed.y / 4}];
    rank = std::max(rank, seed.rank);
  }
  EXPECT_EQ(strongest.found.size(), ranks.size());
  for (const LineSeed& seed : strongest.found) EXPECT_EQ(seed.rank, (ranks[{seed.x / 4, seed.y / 4}]));
}

TEST(LineSeeds, NoneInAnEvenImageOrOnAnEdge) {
  SeedWorkspace workspace;
  find_seeds(Image8(200, 150, 90).view(), rule(), workspace);
  EXPECT_TRUE(workspace.sorted.empty());
  Image8 edge(200, 150, 20);
  for (int y = 0; y < edge.height; ++y)
    for (int x = 100; x < edge.width; ++x) edge(x, y) = 180;
  find_seeds(edge.view(), rule(), workspace);
  EXPECT_TRUE(workspace.sorted.empty());
}

}  // namespace
}  // namespace lightstripe
