// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/end_cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulate/real_stripe.h"

namespace lightstripe {
namespace {

constexpr double kKernel = 4;     // px: twice the stripe's standard deviation, as in grain
constexpr double kGrain = 1.2;    // px along the line, over which rows share their error
constexpr std::size_t kEnd = 16;  // points that lie within four sigma of an end

RealStripe grained(double slope) {
  RealStripe stripe;
  stripe.width = 600;
  stripe.centre = [=](double y) { return 300.3 + slope * (y - 240); };
  stripe.speckle = {0.25, 1.2};
  return stripe;
}

/// One point a row, off the true line by `off(points from the nearer end)`, px across it.
template <class Off>
LineSet line_beside(const RealStripe& stripe, const Off& off, int first = 20, int last = 460) {
  LineSet lines;
  for (int y = first; y < last; ++y) {
    StripePoint p;
    p.normal_x = stripe.cosine(y);
    p.normal_y = -std::copysign(std::sqrt(1 - p.normal_x * p.normal_x), stripe.centre(1) - stripe.centre(0));
    const double by = off(std::min(y - first, last - 1 - y));
    p.x = stripe.centre(y) + by * p.normal_x;
    p.y = y + by * p.normal_y;
    p.width = 2 * std::sqrt(3.0) * stripe.sigma;
    p.strength = 1;
    p.sigma_px = std::hypot(0.1, 0.5 * by);  // near ends the kernels know half of it
    lines.points.push_back(p);
  }
  lines.lines.push_back({0, lines.points.size()});
  return lines;
}

double error_of(const RealStripe& stripe, const StripePoint& p) {
  return (p.x - stripe.centre(p.y)) * stripe.cosine(p.y);
}

/// Errors of the points that lie within so many of an end, over six seeds.
struct EndErrors {
  double mean = 0, rms = 0, sigma = 0;
};
template <class Off>
EndErrors errors_at_ends(double slope, std::size_t count, const Off& off) {
  const RealStripe stripe = grained(slope);
  EndCutWorkspace workspace;
  double sum = 0, squares = 0, predicted = 0, points = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    LineSet lines = line_beside(stripe, off);
    recentre_ends(picture_of(stripe, seed).view(), make_derivative_kernels(kKernel), kGrain, lines,
                  workspace);
    for (std::size_t i = 0; i < count; ++i)
      for (const StripePoint* p : {&lines.points[i], &lines.points[lines.points.size() - 1 - i]}) {
        sum += error_of(stripe, *p);
        squares += std::pow(error_of(stripe, *p), 2);
        predicted += p->sigma_px * p->sigma_px;
        points += 1;
      }
  }
  return {sum / points, std::sqrt(squares / points), std::sqrt(predicted / points)};
}

/// As the kernels do where the light ends obliquely: the last points leave the line.
double drawn_aside(int from_end) { return 1.2 * std::exp(-from_end / 4.0); }

TEST(EndCuts, PointsThatTheEndHasDrawnAsideComeBackToTheLight) {
  for (const double slope : {0.0, 0.4, -0.9}) {
    const EndErrors errors = errors_at_ends(slope, 8, drawn_aside);
    EXPECT_LT(errors.rms, 0.35) << slope;  // 0.67 before
    EXPECT_LT(errors.rms, 1.3 * errors.sigma) << slope;
  }
}

TEST(EndCuts, PointsOnTheLineStayWithinWhatTheGrainLeavesInDoubt) {
  const EndErrors errors = errors_at_ends(0.4, kEnd, [](int) { return 0.0; });
  // The cuts' mean scatters by 0.17 to 0.23 px there, of which half is let through.
  EXPECT_LT(errors.rms, 0.15);
  EXPECT_LT(errors.rms, errors.sigma);
}

TEST(EndCuts, PointsFartherInAndShortLinesStay) {
  const RealStripe stripe = grained(0.2);
  const Image8 picture = picture_of(stripe, 1);
  const auto kernels = make_derivative_kernels(kKernel);
  EndCutWorkspace workspace;
  const LineSet before = line_beside(stripe, drawn_aside);
  LineSet lines = before;
  recentre_ends(picture.view(), kernels, kGrain, lines, workspace);
  EXPECT_NE(lines.points[0].x, before.points[0].x);
  for (std::size_t i = kEnd + 1; i + kEnd + 1 < lines.points.size(); ++i) {
    EXPECT_EQ(lines.points[i].x, before.points[i].x) << i;
    EXPECT_EQ(lines.points[i].sigma_px, before.points[i].sigma_px) << i;
  }
  // Fewer cuts between its ends than would tell how they scatter.
  const LineSet short_before = line_beside(stripe, drawn_aside, 200, 245);
  LineSet short_line = short_before;
  recentre_ends(picture.view(), kernels, kGrain, short_line, workspace);
  for (std::size_t i = 0; i < short_line.points.size(); ++i)
    EXPECT_EQ(short_line.points[i].x, short_before.points[i].x) << i;
}

/// Glow, or a brighter side: kernels and cuts see such a stripe at different places all along.
TEST(EndCuts, WhatDiffersAllAlongTheLineMovesNothing) {
  EXPECT_NEAR(errors_at_ends(0, kEnd, [](int) { return 0.5; }).mean, 0.5, 0.08);
}

/// The strengths tell such ends better.
TEST(EndCuts, LinesWithoutScatterStay) {
  RealStripe stripe = grained(0);
  stripe.speckle.contrast = 0;
  const LineSet before = line_beside(stripe, drawn_aside);
  LineSet lines = before;
  EndCutWorkspace workspace;
  recentre_ends(picture_of(stripe, 1).view(), make_derivative_kernels(kKernel), 0.5, lines, workspace);
  for (std::size_t i = 0; i < lines.points.size(); ++i) EXPECT_EQ(lines.points[i].x, before.points[i].x) << i;
}

/// The light goes on there: it has no end that the kernels could look past.
TEST(EndCuts, LinesThatLeaveThePictureStayThere) {
  const RealStripe stripe = grained(0);
  const LineSet before = line_beside(stripe, drawn_aside, 1, 460);
  LineSet lines = before;
  EndCutWorkspace workspace;
  recentre_ends(picture_of(stripe, 1).view(), make_derivative_kernels(kKernel), kGrain, lines, workspace);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(lines.points[i].x, before.points[i].x) << i;
  EXPECT_NE(lines.points.back().x, before.points.back().x);
}

TEST(EndCuts, GapsAndBridgesNearAnEndLeaveItAsItIs) {
  const RealStripe stripe = grained(0);
  const LineSet before = line_beside(stripe, drawn_aside);
  LineSet lines = before;
  lines.points[5].flags |= kStripeBridged;
  EndCutWorkspace workspace;
  recentre_ends(picture_of(stripe, 1).view(), make_derivative_kernels(kKernel), kGrain, lines, workspace);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(lines.points[i].x, before.points[i].x) << i;
  EXPECT_NE(lines.points.back().x, before.points.back().x);
}

}  // namespace
}  // namespace lightstripe
