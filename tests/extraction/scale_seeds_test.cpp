// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/scale_seeds.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

/// Dots of 2 x 2 pixels on black.
Image8 dots(std::initializer_list<std::array<int, 3>> places) {
  Image8 image(64, 64);
  for (const auto& [x, y, grey] : places)
    for (int k = 0; k < 4; ++k) image(x + k % 2, y + k / 2) = static_cast<std::uint8_t>(grey);
  return image;
}

std::vector<ScaleSeed> seeds_of(const Image8& image, int level) {
  ImagePyramid<std::uint8_t> pyramid;
  build_pyramid(image.view(), 1.0, pyramid);
  SeedWorkspace workspace;
  std::vector<ScaleSeed> found, sorted;
  collect_scale_seeds(pyramid, level, {200, nullptr}, workspace, found);
  sort_by_contrast(found, sorted);
  return sorted;
}

TEST(ScaleSeeds, ComeByFallingContrast) {
  const auto seeds = seeds_of(dots({{10, 10, 60}, {40, 20, 200}, {30, 50, 120}}), 0);
  ASSERT_GE(seeds.size(), 3U);
  for (std::size_t i = 1; i < seeds.size(); ++i) EXPECT_GE(seeds[i - 1].rank, seeds[i].rank);
  EXPECT_NEAR(seeds.front().x, 40, 1);
  EXPECT_NEAR(seeds.front().y, 20, 1);
}

TEST(ScaleSeeds, OfCoarseLevelsLieInTheImagesOwnPixels) {
  const auto seeds = seeds_of(dots({{40, 20, 200}}), 1);
  ASSERT_FALSE(seeds.empty());
  EXPECT_EQ(seeds.front().level, 1);
  EXPECT_NEAR(seeds.front().x, 41, 1);
  EXPECT_NEAR(seeds.front().y, 21, 1);
}

TEST(ScaleSeeds, AreNotWhereTheLasersColourIsMissing) {
  Image8 image = dots({{10, 10, 200}, {40, 20, 200}});
  image.where.assign(image.pixels.size(), LaserPlace::kNone);
  for (int y = 15; y < 30; ++y)
    for (int x = 0; x < 64; ++x) image.where[static_cast<std::size_t>(64 * y + x)] = LaserPlace::kSure;
  const auto seeds = seeds_of(image, 0);
  ASSERT_FALSE(seeds.empty());
  for (const ScaleSeed& s : seeds) EXPECT_NEAR(s.y, 20, 2);
}

TEST(ScaleSeeds, WithColourAreThoseWithoutThatLieInIt) {
  Image8 image(301, 203, 20);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image(x, y) = static_cast<std::uint8_t>(20 + 150 * ((x * 7 + y * 13) % 97 < 9 ? 1 : 0));
  const auto in_colour = [](int x, int y) { return (x / 23 + y / 17) % 5 == 0 || x > 296; };
  for (int level = 0; level < 3; ++level) {
    image.where.clear();
    std::vector<ScaleSeed> expected;
    for (const ScaleSeed& s : seeds_of(image, level))
      if (in_colour(s.x, s.y)) expected.push_back(s);
    image.where.resize(image.pixels.size());
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        image.where[static_cast<std::size_t>(image.width * y + x)] =
            in_colour(x, y) ? LaserPlace::kFaint : LaserPlace::kNone;
    const auto seeds = seeds_of(image, level);
    ASSERT_EQ(seeds.size(), expected.size()) << level;
    for (std::size_t i = 0; i < seeds.size(); ++i)
      EXPECT_TRUE(seeds[i].x == expected[i].x && seeds[i].y == expected[i].y) << level << " " << i;
  }
}

}  // namespace
}  // namespace lightstripe
