// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_ends.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extraction/extract_stripes.h"
#include "extraction/lines/light_end.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

constexpr double kSigma = 0.02;

/// A straight line at y = 50, 80 points, of one strength.
LineSet straight_line() {
  LineSet lines;
  for (int i = 0; i < 80; ++i) {
    StripePoint& p = lines.points.emplace_back();
    p.x = 10 + i, p.y = 50, p.normal_y = 1, p.width = 5, p.strength = 10, p.sigma_px = kSigma;
  }
  lines.lines.push_back({0, 80});
  return lines;
}

TEST(LineEnds, DisturbedPointsGoOnWithTheLine) {
  LineSet lines = straight_line();
  const LightEnd light{2, 5 / std::sqrt(12.0), 1};  // of the points' width, cut at 45 degrees
  for (std::size_t i = 0; i < 10; ++i) {
    const double z = 0.1 + static_cast<double>(i) / light.spread();
    lines.points[i].strength = lines.points[79 - i].strength = 10 * light.strength(z);
    lines.points[i].y += light.shift(z), lines.points[79 - i].y -= light.shift(z);
  }
  EXPECT_GT(lines.points[0].y, 50.4);
  LineEndWorkspace scratch;
  mend_line_ends(make_derivative_kernels(2), EndsOnPrint::kNo, lines, scratch);
  for (const std::size_t i : {0, 1, 2, 3, 4, 5, 74, 75, 76, 77, 78, 79}) {
    EXPECT_NEAR(lines.points[i].y, 50, 0.02) << i;
    EXPECT_NEAR(lines.points[i].x, 10.0 + static_cast<double>(i), 0.02);
    EXPECT_GT(lines.points[i].sigma_px, 0.01) << i;
    EXPECT_LT(lines.points[i].sigma_px, 0.15) << i;
  }
  EXPECT_GT(lines.points[0].sigma_px, lines.points[3].sigma_px);  // farther from what is known
  EXPECT_EQ(lines.points[20].y, 50);                              // far inside nothing is touched
  EXPECT_EQ(lines.points[20].sigma_px, kSigma);
}

TEST(LineEnds, WholeEndsAndShortLinesStay) {
  LineSet lines = straight_line();
  lines.points[0].y = 50.4;  // as strong as all others: no end that the picture blurs
  LineEndWorkspace scratch;
  mend_line_ends(make_derivative_kernels(2), EndsOnPrint::kNo, lines, scratch);
  EXPECT_EQ(lines.points[0].y, 50.4);
}

TEST(LineEnds, WhatNoCutExplainsStays) {
  LineSet lines = straight_line();
  for (std::size_t i = 0; i < 8; ++i) {  // a hook of 6 px
    lines.points[i].y += 6 - 0.75 * static_cast<double>(i);
    lines.points[i].strength = 4 + 0.75 * static_cast<double>(i);
  }
  LineEndWorkspace scratch;
  mend_line_ends(make_derivative_kernels(2), EndsOnPrint::kNo, lines, scratch);
  EXPECT_EQ(lines.points[0].y, 56);
  EXPECT_GT(lines.points[0].sigma_px, 0.3);
}

TEST(LineEnds, WhatFadesOverAShortLineIsNoOtherLines) {
  LineSet lines = straight_line();
  lines.lines = {{0, 37}, {37, 43}, {43, 80}};  // the one in the middle fades from end to end
  lines.fading.assign(80, 0.25F);
  for (std::size_t i = 37; i < 43; ++i) lines.points[i].strength = 0.1 + 1.5 * static_cast<double>(i - 37);
  for (StripePoint& p : lines.points) p.width = 7;
  LineEndWorkspace scratch;
  mend_line_ends(make_derivative_kernels(2), EndsOnPrint::kNo, lines, scratch);
  for (const std::size_t i : {30, 36, 43, 49}) EXPECT_EQ(lines.fading[i], 0.25F) << i;
  EXPECT_EQ(lines.fading[40], 0);  // nowhere is it whole
}

TEST(LineEnds, OfShortLinesOnlySigmaGrows) {
  LineSet stub = straight_line();
  stub.lines[0].end = 15;  // too short to tell how it goes on
  stub.points[0].strength = 4, stub.points[1].strength = 7, stub.points[2].strength = 9;
  for (StripePoint& p : stub.points) p.width = 7;
  stub.points[0].y = 50.4;
  LineEndWorkspace scratch;
  mend_line_ends(make_derivative_kernels(2), EndsOnPrint::kNo, stub, scratch);
  EXPECT_EQ(stub.points[0].y, 50.4);
  EXPECT_GT(stub.points[0].sigma_px, 0.4);  // a cut at 45 degrees draws it 0.5 sigma aside or more
  EXPECT_GT(stub.points[1].sigma_px, stub.points[2].sigma_px);
}

/// A stripe of standard deviation 1.5 px at x = 60 that is cut off at y = 150 by an edge, `tangent` px down
/// for each to the right.
Image8 cut_stripe(double tangent) {
  scenes::Canvas canvas(120, 200, 5);
  canvas.add(scenes::make_line(60.2, -10, 60.2, 210, 160, 1.5));
  canvas.darken_beyond({.x = 60.2, .y = 150, .normal_x = -tangent, .normal_y = 1});
  return canvas.exposed(1, 0, 7);
}

TEST(LineEnds, SigmaHoldsAtCutsOfAnyAngleAndScale) {
  // Broad kernels, as grain asks for, are drawn aside farther than those of the stripe's own scale.
  for (const double sigma : {1.5, 3.0})
    for (const double tangent : {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0}) {
      ExtractionOptions options;
      options.sigma = sigma;
      const auto r = extract_stripes(cut_stripe(tangent).view(), options);
      ASSERT_EQ(r.stripes.size(), 1U);
      double worst = 0, surprise = 0, squares = 0;
      int count = 0;
      for (const StripePoint& p : r.stripes[0].points) {
        if (p.y < 130) continue;
        const double error = std::abs(p.x - 60.2);
        worst = std::max(worst, error);
        surprise = std::max(surprise, error / p.sigma_px);
        squares += error * error / (p.sigma_px * p.sigma_px);
        ++count;
      }
      // Beyond 60 degrees what is left of the stripe is a wedge, whose ridge no cut of the first order
      // explains.
      const bool steep = std::abs(tangent) > 1.5;
      EXPECT_LE(worst, steep ? 0.6 : 0.1) << sigma << ' ' << tangent;
      EXPECT_LE(surprise, steep ? 6 : 4) << sigma << ' ' << tangent;
      EXPECT_LE(squares / count, steep ? 7 : 2) << sigma << ' ' << tangent;
    }
}

/// A straight line that is cut off at 45 degrees at x = 300.
Image8 obliquely_cut_line(double sigma) {
  scenes::Canvas canvas(400, 100, 5);
  canvas.add(scenes::make_line(-10, 50.3, 410, 50.3, 160, sigma));
  canvas.darken_beyond({.x = 300, .y = 50.3, .normal_x = 1, .normal_y = 1});
  return canvas.exposed(1, 0, 4);
}

TEST(LineEnds, ObliqueCutsHardlyShiftTheLastPoints) {
  for (const double sigma : {2.0, 3.0}) {
    ExtractionOptions options;
    options.sigma = sigma;
    const auto r = extract_stripes(obliquely_cut_line(sigma).view(), options);
    ASSERT_EQ(r.stripes.size(), 1U);
    double worst = 0, surprise = 0;
    for (const StripePoint& p : r.stripes[0].points) {
      worst = std::max(worst, std::abs(p.y - 50.3));
      surprise = std::max(surprise, std::abs(p.y - 50.3) / p.sigma_px);
    }
    EXPECT_GT(r.stripes[0].points.back().x, 298);
    // The bare ridge is off by 0.6 sigma where the centre line ends. The continuation is read 3 sigma beyond
    // a parabola over 8 sigma, which itself begins where the ridge bends by a hundredth of a pixel or two.
    EXPECT_LE(worst, 0.06 * sigma) << sigma;
    EXPECT_LE(surprise, 6) << sigma;
  }
}

}  // namespace
}  // namespace lightstripe
