// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/background.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

constexpr int kWidth = 200, kHeight = 300;

double centre_at(double y) { return 100 + 15 * std::sin(y / 60); }

/// Ambient light over a print of bars that run along the line, with a fixed camera noise; `laser`: peak of a
/// line of a standard deviation of 2 px.
template <class T>
Image<T> picture(double laser, double ambient, double print, double noise, double scale, std::uint64_t seed) {
  Image<T> out(kWidth, kHeight);
  Random random(seed);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double d = x - centre_at(y);
      const double level = ambient + print * ((x / 12) % 2) + laser * std::exp(-0.125 * d * d);
      const double largest = sizeof(T) == 1 ? 255.0 : 65535.0;
      out(x, y) =
          static_cast<T>(std::clamp(std::round(scale * (level + noise * random.gaussian())), 0.0, largest));
    }
  return out;
}

struct Found {
  double points = 0, squares = 0, predicted = 0;
  double sigma() const { return std::sqrt(predicted / points); }
  double variance_ratio() const { return squares / predicted; }
};

void add(Found& found, const ExtractionResult& result) {
  for (const Stripe& stripe : result.stripes)
    for (const StripePoint& p : stripe.points) {
      const double slope = 0.25 * std::cos(p.y / 60), off = (p.x - centre_at(p.y)) / std::hypot(1, slope);
      if (std::abs(off) > 3) continue;
      found.points += 1;
      found.squares += off * off;
      found.predicted += p.sigma_px * p.sigma_px;
    }
}

TEST(Background, TheNoiseOfBothPicturesIsCounted) {
  Found alone, both;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Image8 lit = picture<std::uint8_t>(90, 40, 0, 3, 1, seed),
                 dark = picture<std::uint8_t>(0, 40, 0, 3, 1, 100 + seed);
    add(alone, extract_stripes(lit.view()));
    add(both, extract_stripes(subtract_background(lit, dark).image.view()));
  }
  EXPECT_NEAR(both.points, alone.points, 0.01 * alone.points);
  EXPECT_NEAR(both.sigma() / alone.sigma(), std::sqrt(2.0), 0.1);
  EXPECT_GT(both.variance_ratio(), 0.7);
  EXPECT_LT(both.variance_ratio(), 1.4);
}

TEST(Background, WhatIsPrintedOnTheSceneGoes) {
  Found found;
  const Image8 lit = picture<std::uint8_t>(60, 20, 90, 1.5, 1, 3),
               dark = picture<std::uint8_t>(0, 20, 90, 1.5, 1, 4);
  const ExtractionResult result = extract_stripes(subtract_background(lit, dark).image.view());
  add(found, result);
  ASSERT_EQ(result.stripes.size(), 1U);
  EXPECT_GT(found.points, 0.98 * kHeight);
  EXPECT_LT(found.variance_ratio(), 1.4);
  EXPECT_NE(extract_stripes(lit.view()).stripes.size(), 1U) << "the print alone has lines";
}

TEST(Background, AnotherExposureIsPutRight) {
  const Image8 lit = picture<std::uint8_t>(60, 30, 80, 1.5, 1.2, 5),
               dark = picture<std::uint8_t>(0, 30, 80, 1.5, 1, 6);
  const auto light = subtract_background(lit, dark);
  EXPECT_NEAR(light.change.gain, 1.2, 0.03);
  EXPECT_LT(light.darker_share, 0.001);
  EXPECT_EQ(extract_stripes(light.image.view()).stripes.size(), 1U);
}

TEST(Background, ALaserOnlyAddsLight) {
  const Image8 lit = picture<std::uint8_t>(60, 30, 80, 1.5, 1, 5);
  Image8 moved = picture<std::uint8_t>(0, 30, 80, 1.5, 1, 6);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x + 8 < kWidth; ++x) moved(x, y) = moved(x + 8, y);
  EXPECT_GT(subtract_background(lit, moved).darker_share, 0.1);
}

TEST(Background, ClippedPointsStayFlagged) {
  const Image8 lit = picture<std::uint8_t>(400, 80, 0, 1.5, 1, 5),
               dark = picture<std::uint8_t>(0, 80, 0, 1.5, 1, 6);
  const ExtractionResult result = extract_stripes(subtract_background(lit, dark).image.view());
  ASSERT_EQ(result.stripes.size(), 1U);
  std::size_t flagged = 0;
  for (const StripePoint& p : result.stripes[0].points)
    flagged += (p.flags & kStripeSaturated) != 0 ? 1U : 0U;
  EXPECT_GT(static_cast<double>(flagged), 0.95 * static_cast<double>(result.stripes[0].points.size()));
}

TEST(Background, SixteenBitsKeepTheirs) {
  // 12 bits: 16 levels for each of 8 bits, so that noise of a fifth of a level of 8 bits still shows.
  const Image16 lit = picture<std::uint16_t>(60, 20, 40, 0.2, 16, 7),
                dark = picture<std::uint16_t>(0, 20, 40, 0.2, 16, 8);
  Found found;
  const ExtractionResult result = extract_stripes(subtract_background(lit, dark).image.view());
  add(found, result);
  ASSERT_EQ(result.stripes.size(), 1U);
  EXPECT_NEAR(result.noise, 16 * 0.2 * std::sqrt(2.0), 1.0);
  EXPECT_LT(std::sqrt(found.squares / found.points), 0.006);
}

}  // namespace
}  // namespace lightstripe
