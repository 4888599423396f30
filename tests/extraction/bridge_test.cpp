// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/bridge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/stripe.h"

namespace lightstripe {
namespace {

/// On a circle of radius 200 about the origin, at this angle; a line that runs with growing angle.
StripePoint on_circle(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  StripePoint p;
  p.x = 200 * std::cos(a), p.y = 200 * std::sin(a);
  p.normal_x = -std::cos(a), p.normal_y = -std::sin(a);
  p.width = 6 + degrees / 10, p.strength = 4;
  return p;
}

TEST(Bridge, FollowsTheBendOfTheLine) {
  const StripePoint a = on_circle(10), b = on_circle(18);
  ASSERT_TRUE(can_bridge(a, b));
  for (const double u : {0.25, 0.5, 0.75}) {
    const StripePoint p = bridged_point(a, b, u);
    EXPECT_NEAR(std::hypot(p.x, p.y), 200, 0.01) << u;  // the chord is half a pixel off
    EXPECT_GT(p.width, a.width);
    EXPECT_LT(p.width, b.width);
    EXPECT_NEAR(std::abs(p.normal_x * p.x + p.normal_y * p.y), 200, 0.05);
  }
}

TEST(Bridge, ACornerIsNotBridged) {
  StripePoint a = on_circle(0), b = on_circle(5);
  b.normal_x = std::cos(std::numbers::pi / 4), b.normal_y = -std::sin(std::numbers::pi / 4);
  EXPECT_FALSE(can_bridge(a, b));
}

}  // namespace
}  // namespace lightstripe
