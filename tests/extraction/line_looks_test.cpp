// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/line_looks.h"

#include <gtest/gtest.h>

#include <vector>

namespace lightstripe {
namespace {

/// Points of a vertical line at this column.
std::vector<StripePoint> vertical_line(double x, int count) {
  std::vector<StripePoint> points(static_cast<std::size_t>(count));
  for (int y = 0; y < count; ++y) {
    StripePoint& p = points[static_cast<std::size_t>(y)];
    p.x = x;
    p.y = y;
    p.normal_x = 1;
    p.normal_y = 0;
    p.strength = y;
  }
  return points;
}

/// A bar from column 18 to 22, with so much light to its right.
Image8 bar(std::uint8_t right) {
  Image8 image(40, 50);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 40; ++x) image(x, y) = x < 18 ? 10 : x <= 22 ? 200 : right;
  return image;
}

TEST(LineLooks, AnEdgeDropsOnOneSideOnly) {
  const auto points = vertical_line(20, 50);
  EXPECT_FALSE(is_edge(bar(10).view(), points, 2.0));
  EXPECT_FALSE(is_edge(bar(100).view(), points, 2.0));
  EXPECT_TRUE(is_edge(bar(180).view(), points, 2.0));
}

TEST(LineLooks, ClippedMeansAQuarterOfThePoints) {
  Image8 image = bar(10);
  const auto points = vertical_line(20, 50);
  for (int y = 0; y < 12; ++y) image(20, y) = 255;
  EXPECT_FALSE(is_clipped(image.view(), points, 245));
  for (int y = 12; y < 14; ++y) image(20, y) = 255;
  EXPECT_TRUE(is_clipped(image.view(), points, 245));
}

TEST(LineLooks, ALineBesideAnotherOnesMarksIsThatLine) {
  const Image8 image = bar(10);
  const auto points = vertical_line(20, 50);
  ExclusionMask mask;
  mask.reset(40, 50, 0);
  EXPECT_FALSE(runs_beside_another(image.view(), mask, points, 2.0, 5, 0.5));
  for (int y = 0; y < 40; ++y) mask.mark_row(y, 23, 0.6, 4);
  EXPECT_TRUE(runs_beside_another(image.view(), mask, points, 2.0, 5, 0.5));
  // The marks are its own.
  EXPECT_FALSE(runs_beside_another(image.view(), mask, points, 2.0, 4, 0.5));
}

TEST(LineLooks, GrainMakesKernelsUpToTwiceAsBroad) {
  const FollowTuning tuning;
  EXPECT_EQ(broader_in_grain(tuning, 0.5 * tuning.fine_grain), 1);
  EXPECT_NEAR(broader_in_grain(tuning, 0.5 * (tuning.fine_grain + tuning.coarse_grain)), 1.5, 1e-12);
  EXPECT_EQ(broader_in_grain(tuning, 3 * tuning.coarse_grain), 2);
}

TEST(LineLooks, MeanStrength) { EXPECT_NEAR(mean_strength(vertical_line(3, 5)), 2, 1e-12); }

}  // namespace
}  // namespace lightstripe
