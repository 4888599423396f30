// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The colour tells the laser's line from other bright lines, and the parts of a line from each other.
#include "extraction/lines/line_colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

constexpr int kWidth = 60, kHeight = 200, kLongHeight = 400;
constexpr double kCentre = 30, kSigma = 2;

/// A line down the picture; `rise` of its colour over the rise of its grey value from row to row.
template <class Rise>
Image8 coloured_line(const Rise& rise, int height = kHeight) {
  Image8 image(kWidth, height);
  image.where.assign(image.pixels.size(), LaserPlace::kSure);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double light = 100 * std::exp(-0.5 * std::pow((x - kCentre) / kSigma, 2));
      image(x, y) = static_cast<std::uint8_t>(std::lround(40 + light));
      image.rise.push_back(static_cast<std::uint8_t>(std::lround(5 + rise(y) * light)));
    }
  return image;
}

LineSet line_down() {
  LineSet lines;
  for (int y = 0; y < kHeight; ++y) {
    StripePoint p;
    p.x = kCentre;
    p.y = y;
    p.normal_x = 1;
    p.width = 3.46 * kSigma;
    p.intensity = 100;
    lines.points.push_back(p);
  }
  lines.lines = {{0, lines.points.size()}};
  return lines;
}

LineColour colour_of(const Image8& image) {
  const LineSet lines = line_down();
  ColourWorkspace workspace;
  return colour_of_line(image.view(), lines, lines.lines[0], 3.46 * kSigma, workspace);
}

TEST(LineColour, RisesWithTheLightOfTheLaserOnly) {
  const LineColour laser = colour_of(coloured_line([](int) { return 0.6; }));
  EXPECT_TRUE(laser.known);
  EXPECT_NEAR(laser.share, 0.6, 0.03);
  EXPECT_NEAR(laser.rise, 60, 3);
  EXPECT_NEAR(colour_of(coloured_line([](int) { return 0.0; })).share, 0, 0.01);
}

TEST(LineColour, OfABleachedCoreIsThatOfItsRims) {
  Image8 image = coloured_line([](int) { return 0.6; });
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double rim = std::exp(-0.5 * std::pow((std::abs(x - kCentre) - 3.5) / 1.0, 2));
      image.rise[static_cast<std::size_t>(y * kWidth + x)] = static_cast<std::uint8_t>(std::lround(40 * rim));
    }
  EXPECT_GT(colour_of(image).share, 0.3);
  // A slope, as of the glow beside an edge, is no rim.
  for (std::size_t i = 0; i < image.rise.size(); ++i)
    image.rise[i] = static_cast<std::uint8_t>(2 * (i % kWidth));
  EXPECT_NEAR(colour_of(image).share, 0, 0.03);
}

TEST(LineColour, IsNotKnownWhereTheLineIsClippedOrThePictureIsGrey) {
  Image8 image = coloured_line([](int) { return 0.6; });
  for (int y = 0; y < kHeight; y++)
    for (int x = 27; x < 34; ++x) image.rise[static_cast<std::size_t>(y * kWidth + x)] = kClippedRise;
  EXPECT_FALSE(colour_of(image).known);
  image.rise.clear();
  EXPECT_FALSE(colour_of(image).known);
}

TEST(LineColour, TellsWhereFollowingWentAlongAnEdgeInOtherLight) {
  const Image8 image = coloured_line([](int y) { return y < 120 ? 0.6 : 0.05; });
  const LineSet lines = line_down();
  ColourWorkspace workspace;
  std::vector<std::uint8_t> place(lines.points.size());
  place_points(image.view(), lines, lines.lines[0], 3.46 * kSigma, workspace, place);
  for (std::size_t y = 0; y < 116; ++y) EXPECT_EQ(place[y], LaserPlace::kSure) << y;
  for (std::size_t y = 124; y < place.size(); ++y) EXPECT_EQ(place[y], LaserPlace::kOtherLight) << y;
}

TEST(LineColour, ALineInOtherLightIsDroppedAndAnAstrayEndIsCutOff) {
  EXPECT_EQ(extract_stripes(coloured_line([](int) { return 0.6; }).view()).stripes.size(), 1U);
  EXPECT_TRUE(extract_stripes(coloured_line([](int) { return 0.02; }).view()).stripes.empty());
  const auto found = extract_stripes(coloured_line([](int y) { return y < 120 ? 0.6 : 0.05; }).view());
  ASSERT_EQ(found.stripes.size(), 1U);
  EXPECT_NEAR(found.stripes[0].points.back().y, 120, 8);
}

TEST(LineColour, ALongLineOfWhichACodecLeftLittleColourStays) {
  const auto stripes = [](double rise) {
    return extract_stripes(coloured_line([&](int) { return rise; }, kLongHeight).view()).stripes.size();
  };
  EXPECT_EQ(stripes(0.05), 1U);
  EXPECT_EQ(stripes(0.0), 0U);
}

}  // namespace
}  // namespace lightstripe
