// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Width, intensity and flags of points by the unsmoothed image.
#include "extraction/lines/line_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "extraction/kernels/kernels.h"

namespace lightstripe {
namespace {

Image8 columns(const std::function<double(int)>& grey) {
  Image8 image(80, 120);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey(x)), 0L, 255L));
  return image;
}

/// The points of a vertical line at x = 40, measured.
LineSet measured(const Image8& image, double sigma, double noise = 0.5) {
  LineSet lines;
  for (int y = 0; y < image.height; ++y) {
    StripePoint p;
    p.x = 40;
    p.y = y;
    p.normal_x = 1;
    p.strength = 10;
    lines.points.push_back(p);
  }
  lines.lines = {{0, lines.points.size()}};
  LineMeasures measures;
  measure_points(image.view(), make_derivative_kernels(sigma), noise, lines, measures);
  return lines;
}

double gauss(int x, double sigma) { return std::exp(-0.5 * (x - 40) * (x - 40) / (sigma * sigma)); }

TEST(LineMeasure, AGaussianStripeHasTheWidthOfTheBarOfItsStandardDeviation) {
  for (const double sigma : {1.5, 3.0, 5.0}) {
    const LineSet lines = measured(columns([&](int x) { return 20 + 150 * gauss(x, sigma); }), sigma);
    const StripePoint& p = lines.points[60];
    EXPECT_NEAR(p.width, 2 * std::sqrt(3.0) * sigma, 0.08 * p.width + 0.2) << sigma;
    EXPECT_NEAR(p.intensity, 150, 20) << sigma;
    EXPECT_EQ(p.flags, 0) << sigma;
  }
}

TEST(LineMeasure, ClippedAndOneSidedProfilesAreFlagged) {
  const LineSet clipped = measured(columns([&](int x) { return 20 + 800 * gauss(x, 2); }), 3);
  EXPECT_NE(clipped.points[60].flags & kStripeSaturated, 0);
  const LineSet tail = measured(
      columns([&](int x) { return 20 + 150 * (x < 40 ? gauss(x, 1.5) : std::exp(-(x - 40) / 7.0)); }), 3);
  EXPECT_NE(tail.points[60].flags & kStripeAsymmetric, 0);
}

}  // namespace
}  // namespace lightstripe
