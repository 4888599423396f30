// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The grey-value methods take each line along the axis that crosses it best.
#include "extraction/compare/grey_value_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/random.h"
#include "extraction/extract_stripes.h"

namespace lightstripe {
namespace {

constexpr int kSize = 300;

/// Distance from a line at a place, px.
using Distance = std::function<double(double, double)>;

/// Light around the lines, grey levels at a place.
using Floor = std::function<double(double, double)>;

Image8 picture_of(const std::vector<Distance>& lines, const Floor& floor) {
  Random random(4, 9);
  Image8 image(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      double grey = floor(x, y) + 1.5 * random.gaussian();
      for (const Distance& distance : lines) {
        const double d = distance(x, y);
        grey += 170 * std::exp(-0.5 * d * d / 4);
      }
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  return image;
}

struct Found {
  std::size_t lines = 0;
  double points = 0, rms = 0, off = 0;  ///< px; points farther than 1 px off
};

double dark(double /*x*/, double /*y*/) { return 10; }

Found found_in(const std::vector<Distance>& lines, const Floor& floor = dark) {
  ExtractionOptions options;
  options.method = ExtractionMethod::kCentroid;
  const auto result = extract_stripes(picture_of(lines, floor).view(), options);
  Found found;
  found.lines = result.stripes.size();
  for (const Stripe& stripe : result.stripes)
    for (const StripePoint& p : stripe.points) {
      double d = 1e9;
      for (const Distance& distance : lines) d = std::min(d, std::abs(distance(p.x, p.y)));
      found.points += 1;
      found.off += d > 1 ? 1 : 0;
      found.rms += d * d;
    }
  found.rms = std::sqrt(found.rms / std::max(1.0, found.points));
  return found;
}

Distance straight(double degrees, double through_x, double through_y) {
  const double a = degrees * M_PI / 180;
  return [=](double x, double y) { return (x - through_x) * std::sin(a) - (y - through_y) * std::cos(a); };
}

TEST(GreyValueLines, LinesNearBothAxesInOnePictureAreEachTakenAlongTheBetterOne) {
  const Found found = found_in({straight(3, 150, 60.3), straight(92, 90.4, 150)});
  EXPECT_GT(found.points, 0.96 * 2 * kSize);
  EXPECT_LT(found.points, 1.04 * 2 * kSize);
  EXPECT_LT(found.off, 20);  // around the crossing
}

TEST(GreyValueLines, ALineAtAnyAngleIsTakenOnceAndWhole) {
  for (const double degrees : {0.0, 20.0, 44.0, 45.0, 46.0, 70.0, 90.0, 120.0}) {
    const Found found = found_in({straight(degrees, 150.2, 150.3)});
    const double rows = degrees == 0 || degrees == 90 ? kSize : 0.9 * kSize;
    EXPECT_GT(found.points, rows - 8) << degrees;
    EXPECT_LT(found.points, kSize + 8) << degrees;
    EXPECT_LT(found.rms, 0.06) << degrees;
  }
}

TEST(GreyValueLines, ACircleIsTakenInPartsWithoutGaps) {
  const Found found = found_in({[](double x, double y) { return std::hypot(x - 150.3, y - 149.6) - 100; }});
  // Columns from -45 to 45 degrees and rows for the rest: 4 * 100 sqrt 2 points.
  EXPECT_GT(found.points, 560);
  EXPECT_LT(found.points, 620);
  EXPECT_LT(found.rms, 0.1);
}

TEST(GreyValueLines, ALineInAGlowOrOnALitFloorIsFoundAndTheFloorIsNot) {
  const Distance line = straight(88, 150, 150.2);
  const auto glow = [&](double x, double y) {
    const double d = line(x, y);
    return 10 + 50 * std::exp(-std::abs(d) / 15);
  };
  // Half of the picture lies in the room's light; its edge is no line.
  const auto lit = [](double /*x*/, double y) { return y > 140 ? 70.0 : 10.0; };
  for (const Floor& floor : {Floor(glow), Floor(lit)}) {
    const Found found = found_in({line}, floor);
    EXPECT_GT(found.points, 0.97 * kSize);
    EXPECT_LT(found.off, 0.02 * kSize);
    EXPECT_LT(found.rms, 0.3);
  }
}

}  // namespace
}  // namespace lightstripe
