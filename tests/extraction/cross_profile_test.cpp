// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/cross_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lightstripe {
namespace {

Image8 row_of(const std::function<double(double)>& light) {
  Image8 image(120, 1);
  for (int x = 0; x < 120; ++x) image(x, 0) = static_cast<std::uint8_t>(std::lround(light(x)));
  return image;
}

TEST(CrossProfile, AGaussianHasItsWidthAndItsPeak) {
  const double s = 3;
  const Image8 image =
      row_of([&](double x) { return 20 + 200 * std::exp(-0.5 * std::pow((x - 60) / s, 2)); });
  const CrossProfile p = measure_profile(row_line(image.view(), 0), 60, 24);
  EXPECT_TRUE(p.bounded);
  EXPECT_NEAR(p.width(), 2 * std::sqrt(3.0) * s, 0.3);
  EXPECT_NEAR(p.half_level_width, 2.3548 * s, 0.3);
  EXPECT_NEAR(p.background_left, 20, 0.5);
  EXPECT_NEAR(p.brightest, 220, 0.5);
  EXPECT_NEAR(p.contrast(), p.top - 20, 0.5);
  EXPECT_NEAR(bar_width(p.width(), p.half_level_width), p.width(), 0.4);
}

TEST(CrossProfile, ABarHasTheWidthOfItsFlanks) {
  const Image8 image = row_of([](double x) { return std::abs(x - 60) < 7.6 ? 180.0 : 30.0; });
  const CrossProfile p = measure_profile(row_line(image.view(), 0), 60, 24);
  EXPECT_NEAR(p.width(), 15, 1);
  EXPECT_NEAR(bar_width(p.width(), p.half_level_width), 15, 1);
}

TEST(CrossProfile, AnEdgeHasContrastOnOneSideOnly) {
  const Image8 image = row_of([](double x) { return x < 55 ? 30.0 : 180.0; });
  const CrossProfile p = measure_profile(row_line(image.view(), 0), 58, 20);
  EXPECT_NEAR(p.contrast(), 0, 1);
}

TEST(CrossProfile, ANeighbourIsNotTakenForBackground) {
  const Image8 image = row_of([](double x) {
    return 20 + 150 * std::exp(-0.5 * std::pow((x - 50) / 2, 2)) +
           150 * std::exp(-0.5 * std::pow((x - 66) / 2, 2));
  });
  const CrossProfile p =
      measure_profile(row_line(image.view(), 0), 50, 16);  // the reach ends on the neighbour
  EXPECT_LT(p.background_right, 30);
}

}  // namespace
}  // namespace lightstripe
