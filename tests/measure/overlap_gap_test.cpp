// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/overlap_gap.h"

#include <gtest/gtest.h>

#include "block.h"

namespace lightstripe {
namespace {

/// Sensor 0 sees the top to the right of -half, sensor 1 to the left of half, 0.03 mm lower.
OnBlock two_views(double half) {
  OnBlock block;
  for (double u = -18; u <= 18; u += 0.25) {
    if (u >= -half) block.add(u, 0, 0);
    if (u <= half) block.add(u, -0.03, 1);
  }
  return block;
}

TEST(OverlapGap, IsHowMuchHigherTheFirstSensorSees) {
  OnBlock block = two_views(8);
  block.registration.error = {0.01, 0, 1};
  const Estimate gap = overlap_gap(block.placed());
  ASSERT_TRUE(gap.value) << gap.reason;
  EXPECT_NEAR(*gap.value, 0.03, 1e-9);
  // 64 points of either sensor share nothing; 1.2: a strip's height is a median.
  EXPECT_NEAR(*gap.sigma, std::sqrt(2 * 1.2 / 64) * 0.01, 0.0002);
}

TEST(OverlapGap, NeedsFiveCommonMillimetresAndTwoSensors) {
  EXPECT_FALSE(overlap_gap(two_views(1.9).placed()).value);
  OnBlock one;
  for (double u = -18; u <= 18; u += 0.25) one.add(u, 0);
  EXPECT_EQ(overlap_gap(one.placed()).reason, "one sensor only");
}

}  // namespace
}  // namespace lightstripe
