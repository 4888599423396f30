// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_fade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "extraction/extract_stripes.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

/// 200 points of sigma 0.02 px, 7 px wide (s = 2.02 px), of the strength 10, from point 100 on of a third of
/// it.
LineSet stained_line() {
  LineSet lines = scenes::level_line(200, 7);
  for (int i = 0; i < 200; ++i) {
    StripePoint& p = lines.points[static_cast<std::size_t>(i)];
    p.sigma_px = 0.02;
    p.strength = 10 - 6.67 / (1 + std::exp(-(i - 100) / 1.5)) + 0.05 * (i % 3);
  }
  return lines;
}

TEST(LineFade, CountsWhereTheStrengthChanges) {
  LineSet lines = stained_line();
  std::vector<float> scratch;
  find_fade_errors(make_derivative_kernels(2), lines, scratch);
  ASSERT_EQ(lines.fading.size(), 200U);
  // Half of s^2 = 4.08 times the change over four px, 2 (9.2 - 4.1) / (2 (9.2 + 4.1)) = 0.19 at the most.
  EXPECT_NEAR(lines.fading[101], 0.5 * 4.08 * 0.19, 0.12);
  EXPECT_EQ(lines.fading[30], 0);  // the grain of the whole line is no fading
  EXPECT_EQ(lines.fading[170], 0);
  add_systematic_errors(lines);
  EXPECT_NEAR(lines.points[101].sigma_px, std::hypot(0.02, double{lines.fading[101]}), 1e-6);
  EXPECT_EQ(lines.points[30].sigma_px, 0.02);
}

/// A stripe over the oblique border of a stain, on which it is a third as bright.
TEST(LineFade, SigmaHoldsOverAnObliqueStain) {
  for (const double tangent : {-0.3, -0.2, 0.2, 0.3}) {
    scenes::Canvas canvas(300, 100, 5);
    canvas.add(scenes::make_line(-10, 50.3, 310, 50.3, 160, 2));
    canvas.darken_beyond({.x = 150, .y = 50.3, .normal_x = 1, .normal_y = tangent}, 0.667);
    ExtractionOptions options;
    options.sigma = 2;
    const auto r = extract_stripes(canvas.exposed(1, 0, 3).view(), options);
    ASSERT_EQ(r.stripes.size(), 1U);
    double worst = 0, surprise = 0;
    for (const StripePoint& p : r.stripes[0].points) {
      if ((p.flags & kStripeBridged) != 0) continue;  // its error is the bridge's
      worst = std::max(worst, std::abs(p.y - 50.3));
      surprise = std::max(surprise, std::abs(p.y - 50.3) / p.sigma_px);
    }
    EXPECT_GT(worst, 0.05) << tangent;  // the stain does shift the line
    EXPECT_LE(surprise, 4) << tangent;
  }
}

}  // namespace
}  // namespace lightstripe
