// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_ends.h"

#include <gtest/gtest.h>

#include <array>

namespace lightstripe {
namespace {

constexpr double kSigma = 0.02;

/// A straight line at y = 50, 80 points, of one strength.
LineSet straight_line() {
  LineSet lines;
  for (int i = 0; i < 80; ++i) {
    StripePoint& p = lines.points.emplace_back();
    p.x = 10 + i, p.y = 50, p.normal_y = 1, p.strength = 10, p.sigma_px = kSigma;
  }
  lines.lines.push_back({0, 80});
  return lines;
}

TEST(LineEnds, WeakPointsGoOnWithTheLine) {
  const std::array<double, 4> strength{2, 4, 6, 8}, off{0.5, 0.3, 0.15, 0.05};
  LineSet lines = straight_line();
  for (std::size_t i = 0; i < 4; ++i) {
    lines.points[i].strength = lines.points[79 - i].strength = strength.at(i);
    lines.points[i].y += off.at(i), lines.points[79 - i].y -= off.at(i);
  }
  mend_line_ends(make_derivative_kernels(2), lines);
  for (const std::size_t i : {0, 1, 2, 3, 76, 77, 78, 79}) {
    EXPECT_NEAR(lines.points[i].y, 50, 0.03) << i;
    EXPECT_EQ(lines.points[i].x, 10.0 + static_cast<double>(i));
    EXPECT_GT(lines.points[i].sigma_px, 0.01) << i;
    EXPECT_LT(lines.points[i].sigma_px, 0.1) << i;
  }
  EXPECT_GT(lines.points[0].sigma_px, lines.points[3].sigma_px);  // farther from what is known
  EXPECT_EQ(lines.points[4].y, 50);
  EXPECT_EQ(lines.points[4].sigma_px, kSigma);
}

TEST(LineEnds, WholeEndsAndShortLinesStay) {
  LineSet lines = straight_line();
  lines.points[0].y = 50.4;  // as strong as all others: no end that the picture blurs
  mend_line_ends(make_derivative_kernels(2), lines);
  EXPECT_EQ(lines.points[0].y, 50.4);
  LineSet stub = straight_line();
  stub.lines[0].end = 25;  // too short for the wider parabola
  stub.points[0].strength = 2, stub.points[0].y = 50.4;
  mend_line_ends(make_derivative_kernels(2), stub);
  EXPECT_EQ(stub.points[0].y, 50.4);
}

}  // namespace
}  // namespace lightstripe
