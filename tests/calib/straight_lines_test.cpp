// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/straight_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lightstripe {
namespace {

void add(Stripe& stripe, double from, double to, double y, double slope = 0) {
  for (double x = from; x < to; ++x)
    stripe.points.push_back({.x = x, .y = y + slope * (x - from), .normal_y = 1});
}

TEST(StraightLines, ABlockBreaksTheLineInThree) {
  Stripe stripe;
  add(stripe, 0, 120, 200);
  add(stripe, 120, 200, 150);
  add(stripe, 200, 300, 200.5);
  const auto lines = straight_lines({stripe});
  ASSERT_GE(lines.size(), 2u);  // both pieces of the bed may be one straight line
  const auto top = std::find_if(lines.begin(), lines.end(), [](const auto& line) {
    return std::all_of(line.begin(), line.end(), [](const StripePoint& p) { return p.y < 160; });
  });
  ASSERT_NE(top, lines.end());
  EXPECT_GE(top->size(), 75u);
}

TEST(StraightLines, TheLongestComesFirstAndCrumbsAreLeftOut) {
  Stripe crumb, shorter, longer;
  add(crumb, 0, 15, 10);
  add(shorter, 0, 60, 80, 0.1);
  add(longer, 0, 90, 160, -0.05);
  const auto lines = straight_lines({crumb, shorter, longer});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].size(), 90u);
  EXPECT_EQ(lines[1].size(), 60u);
}

}  // namespace
}  // namespace lightstripe
