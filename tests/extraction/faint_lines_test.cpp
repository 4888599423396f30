// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The lines of one picture judged against each other: faint ones are dropped, unless they go on where a
// strong one ends.
#include "extraction/lines/faint_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

/// A piece of a vertical line.
struct Piece {
  double x, first, last, peak;  ///< px, rows, grey levels
};

Image8 picture_of(const std::vector<Piece>& pieces) {
  Random random(5, 7);
  Image8 image(320, 400);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double level = 12 + 0.7 * random.gaussian();
      for (const Piece& p : pieces)
        if (y >= p.first && y <= p.last) level += p.peak * std::exp(-0.5 * std::pow((x - p.x) / 2, 2));
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  return image;
}

/// Rows with a point within 2 px of `x`, from `first` to `last`.
int rows_found(const ExtractionResult& result, double x, double first, double last) {
  int rows = 0;
  for (const Stripe& stripe : result.stripes)
    for (const StripePoint& p : stripe.points)
      rows += std::abs(p.x - x) < 2 && p.y >= first && p.y <= last ? 1 : 0;
  return rows;
}

TEST(FaintLines, ADimPieceStaysWhereTheLineGoesOnAndNowhereElse) {
  const Piece strong{100.3, 0, 200, 150}, dim{100.3, 215, 285, 14}, elsewhere{220.3, 215, 285, 14};
  const auto result = extract_stripes(picture_of({strong, dim, elsewhere}).view());
  EXPECT_GT(rows_found(result, strong.x, 0, 200), 195);
  EXPECT_GT(rows_found(result, dim.x, 215, 285), 60);
  EXPECT_EQ(rows_found(result, elsewhere.x, 0, 400), 0);
}

TEST(FaintLines, AsLongAsTheStrongOneAFaintLineNeedsNoOther) {
  const auto result = extract_stripes(picture_of({{100.3, 0, 399, 150}, {220.3, 0, 399, 18}}).view());
  EXPECT_GT(rows_found(result, 220.3, 0, 399), 390);
}

/// How much of a pixel lies between two places, with the blur of a lens.
double between(double at, double first, double last) {
  constexpr double kBlur = 0.8;  // px
  return 0.5 * (std::erf((at - first) / kBlur) - std::erf((at - last) / kBlur));
}

/// White sheets on a dark table, and a line of light down the picture: on the sheets it is far brighter than
/// they are, on the table it rises by as much as a sheet does. `laser`: 0 where it is off.
Image8 sheets_on_a_table(double laser) {
  Random random(5, 8);
  Image8 image(320, 400);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double sheets = 0;
      for (const double left : {20.0, 120.0, 220.0})
        for (const double top : {15.0, 215.0})
          sheets += between(x - 0.05 * y, left, left + 70) * between(y, top, top + 170);
      const double light = std::exp(-0.5 * std::pow((x - 150.3) / 2, 2));
      const double level =
          20 + 110 * sheets + laser * (0.55 + 0.45 * sheets) * light + 0.7 * random.gaussian();
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  return image;
}

TEST(FaintLines, LightOnBrightThingsIsBrighterThanTheyAre) {
  EXPECT_GT(rows_found(extract_stripes(sheets_on_a_table(110).view()), 150.3, 0, 399), 390);
  EXPECT_TRUE(extract_stripes(sheets_on_a_table(0).view()).stripes.empty());
}

TEST(FaintLines, AFlatTopBelowTheEndOfTheRangeIsNoLight) {
  Random random(5, 9);
  Image8 image(320, 400);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double lamp = 220 * between(x, 280, 310) * between(y, 180, 210);
      const double level = 35 + 110 * between(x, 100, 127) + lamp + 0.7 * random.gaussian();
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  EXPECT_TRUE(extract_stripes(image.view()).stripes.empty());
}

}  // namespace
}  // namespace lightstripe
