// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/seed_chains.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

constexpr int kWidth = 400, kHeight = 300;

std::vector<ScaleSeed> chained(const std::vector<ScaleSeed>& seeds, int least_length) {
  SeedChainWorkspace workspace;
  std::vector<ScaleSeed> found;
  collect_chained_seeds(seeds, kWidth, kHeight, least_length, workspace, found);
  return found;
}

/// A seed in each cell of 4 x 4 px from x = `first` to `end` on a line of that slope.
std::vector<ScaleSeed> row_of_seeds(int first, int end, double y, double slope, std::int16_t rank) {
  std::vector<ScaleSeed> seeds;
  for (int x = first; x < end; x += 4)
    seeds.push_back({x, static_cast<int>(std::lround(y + slope * (x - first))), 0, rank});
  return seeds;
}

std::vector<ScaleSeed> transposed(std::vector<ScaleSeed> seeds) {
  for (ScaleSeed& s : seeds) std::swap(s.x, s.y);
  return seeds;
}

TEST(SeedChains, TheLongestRowComesFirstWhateverItsContrast) {
  auto seeds = row_of_seeds(200, 280, 50, 0, 200);
  const auto faint = row_of_seeds(20, 300, 150, 0.3, 10);
  seeds.insert(seeds.end(), faint.begin(), faint.end());
  const auto found = chained(seeds, 60);
  ASSERT_EQ(found.size(), seeds.size());
  for (std::size_t k = 0; k < faint.size(); ++k) EXPECT_EQ(found[k].rank, 10) << k;
}

TEST(SeedChains, AreFoundAlongRowsAndColumnsAndAt45Degrees) {
  for (const double slope : {0.0, 0.5, 1.0, -0.9}) {
    const auto seeds = row_of_seeds(20, 220, slope < 0 ? 250 : 20, slope, 30);
    EXPECT_EQ(chained(seeds, 180).size(), seeds.size()) << slope;
    const auto upright = transposed(seeds);
    EXPECT_EQ(chained(upright, 180).size(), upright.size()) << slope;
  }
}

TEST(SeedChains, AGapCostsAsMuchAsItIsLong) {
  auto seeds = row_of_seeds(20, 120, 100, 0, 30);        // 25 cells
  const auto rest = row_of_seeds(140, 240, 100, 0, 30);  // 25 more after a gap of 5
  seeds.insert(seeds.end(), rest.begin(), rest.end());
  EXPECT_EQ(chained(seeds, 4 * 45).size(), seeds.size());
  EXPECT_TRUE(chained(seeds, 4 * 46).empty());
}

TEST(SeedChains, ATextureHasNone) {
  std::vector<ScaleSeed> seeds;
  for (int y = 0; y < kHeight; y += 4)
    for (int x = 0; x < kWidth; x += 4) seeds.push_back({x, y, 0, 90});
  // But for its border, which has nothing beyond it.
  for (const ScaleSeed& s : chained(seeds, 40)) EXPECT_TRUE(s.x < 8 || s.y < 8 || s.x >= 392 || s.y >= 292);
}

TEST(SeedChains, ALongFaintLineAmongBrightThingsIsFound) {
  Random random(8, 2);
  Image8 image(640, 480);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      // Short strokes, as bright as 130 grey levels, cover the upper two thirds of the picture.
      double grey = 60 + 2.5 * random.gaussian();
      if (y < 320) {
        const int column = x / 13, row = y / 11;
        const double turn = 2.4 * column + 1.7 * row, dx = x % 13 - 6, dy = y % 11 - 5;
        const double along = dx * std::cos(turn) + dy * std::sin(turn),
                     across = dy * std::cos(turn) - dx * std::sin(turn);
        grey += 130 * std::exp(-along * along / 14 - across * across / 3);
      }
      const double d = y - 400 - 0.05 * x;
      grey += 30 * std::exp(-0.5 * d * d / 3);
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  double found = 0;
  for (const Stripe& stripe : extract_stripes(image.view(), ExtractionOptions{}).stripes)
    for (const StripePoint& p : stripe.points) found += std::abs(p.y - 400 - 0.05 * p.x) < 1 ? 1 : 0;
  EXPECT_GT(found, 0.97 * 640);
}

}  // namespace
}  // namespace lightstripe
