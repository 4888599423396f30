// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture without a line says what it looks like.
#include "extraction/image/impression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/random.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

Impression of(const std::function<double(int, int)>& level, double noise) {
  Random random(8, 1);
  Image8 image(320, 240);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image(x, y) = static_cast<std::uint8_t>(
          std::clamp(std::lround(level(x, y) + noise * random.gaussian()), 0L, 255L));
  const auto result = extract_stripes(image.view());
  EXPECT_TRUE(result.stripes.empty());
  return result.impression;
}

TEST(Impression, TellsDarkClippedEvenAndEdgedPicturesApart) {
  EXPECT_EQ(of([](int, int) { return 6.0; }, 1), Impression::kDark);
  EXPECT_EQ(of([](int x, int) { return x < 150 ? 255.0 : 80.0; }, 1), Impression::kOverexposed);
  EXPECT_EQ(of([](int, int) { return 90.0; }, 3), Impression::kEven);
  // Paper on a table, with a rim that the camera has sharpened.
  EXPECT_EQ(of(
                [](int x, int) {
                  return 40 + 60 * std::erfc((x - 150) / 3.0) + 35 * std::exp(-(x - 147) * (x - 147) / 8.0);
                },
                2),
            Impression::kEdges);
  // One spot.
  EXPECT_EQ(of([](int x, int y) { return std::hypot(x - 100, y - 90) < 4 ? 200.0 : 30.0; }, 2),
            Impression::kTooFaint);
}

TEST(Impression, ACrowdOfCrumbsLooksLikeNoise) {
  Random places(3, 2);
  Image8 blots(320, 240);
  for (int k = 0; k < 500; ++k) {
    const double x = places.uniform(4, 315), y = places.uniform(4, 235), angle = places.uniform(0, 3.14);
    for (int i = -2; i <= 2; ++i)
      blots(static_cast<int>(x + i * std::cos(angle)), static_cast<int>(y + i * std::sin(angle))) = 120;
  }
  EXPECT_EQ(of([&](int x, int y) { return 40.0 + blots(x, y); }, 4), Impression::kNoise);
}

TEST(Impression, IsNoneWhereALineIsAndHasWordsElsewhere) {
  Image8 image(320, 240, 20);
  for (int y = 0; y < 240; ++y)
    for (int x = 97; x < 104; ++x) image(x, y) = 200;
  EXPECT_EQ(extract_stripes(image.view()).impression, Impression::kNone);
  for (const Impression i : {Impression::kOverexposed, Impression::kDark, Impression::kEven,
                             Impression::kNoise, Impression::kEdges, Impression::kTooFaint}) {
    EXPECT_FALSE(what_it_looks_like(i).empty());
    EXPECT_FALSE(what_to_do_about(i).empty());
  }
}

}  // namespace
}  // namespace lightstripe
