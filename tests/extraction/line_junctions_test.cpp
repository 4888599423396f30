// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Bridges over crossings lie on the curve through both sides.
#include "extraction/lines/line_junctions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

double x_at(double y) { return 100 + 0.002 * (y - 100) * (y - 100); }

/// A bent line, bridged from 96 to 104; its points beside the bridge are drawn aside as a crossing does.
LineSet crossed_line() {
  Random random(2, 2);
  LineSet lines;
  for (int y = 0; y < 200; ++y) {
    StripePoint p;
    p.y = y;
    p.x = x_at(y) + 0.01 * random.gaussian();
    p.normal_x = 1;
    p.sigma_px = 0.01;
    p.strength = 10;
    if (std::abs(y - 100) <= 7) p.x += 0.5;
    if (std::abs(y - 100) <= 4) {
      p.x += 0.5;
      p.flags = kStripeBridged;
      p.sigma_px = 0.3;  // predict_errors knows the gap
    }
    lines.points.push_back(p);
  }
  lines.lines = {{0, lines.points.size()}};
  return lines;
}

/// As bright everywhere: as where two lines cross.
Image8 even_light() { return Image8(200, 200, 90); }

TEST(LineJunctions, TheBridgeAndWhatWasDrawnAsideGoToTheCurve) {
  LineSet lines = crossed_line();
  mend_junctions(even_light().view(), make_derivative_kernels(2), lines);
  for (const StripePoint& p : lines.points) EXPECT_NEAR(p.x, x_at(p.y), 0.06) << p.y;
  EXPECT_NE(lines.points[94].flags & kStripeBridged, 0);
  EXPECT_EQ(lines.points[100].sigma_px, 0.3);
  EXPECT_GE(lines.points[94].sigma_px, 0.2);  // drawn aside: a tenth of the scale at least
  EXPECT_EQ(lines.points[60].flags, 0);
}

TEST(LineJunctions, NearAnEndThereIsNoCurveThroughBothSides) {
  LineSet lines = crossed_line();
  lines.lines = {{90, 200}};
  const double before = lines.points[100].x;
  mend_junctions(even_light().view(), make_derivative_kernels(2), lines);
  EXPECT_EQ(lines.points[100].x, before);
}

// A clipped spot in the corner of a rail's head, 61 points long, went onto the parabola through both sides,
// 1.3 mm off the light at a predicted 0.13.
TEST(LineJunctions, TheCurveDoesNotLeaveTheLight) {
  LineSet lines = crossed_line();
  Image8 light(200, 200, 20);
  for (StripePoint& p : lines.points) {
    p.intensity = 100;
    const double from_middle = std::abs(p.y - 100);
    if (from_middle <= 12) p.x -= 8 * (1 - from_middle / 12);  // a bend, in which the light goes on
    for (int x = -2; x <= 2; ++x) light(static_cast<int>(std::lround(p.x)) + x, static_cast<int>(p.y)) = 120;
  }
  const LineSet before = lines;
  mend_junctions(light.view(), make_derivative_kernels(2), lines);
  for (std::size_t i = 0; i < lines.points.size(); ++i)
    EXPECT_NEAR(lines.points[i].x, before.points[i].x, 1) << lines.points[i].y;
}

}  // namespace
}  // namespace lightstripe
