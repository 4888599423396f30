// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/section_bends.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

// By hand: a = (40 - 20) / 10 = 2, b = (-5 - 10) / 10 = -1.5.
TEST(SectionBends, DisplaceByAPolynomialOfTheirSensor) {
  SectionBends bends{{20, 10}, 10, {std::vector<double>(24, 0.0)}};
  bends.bends[0] = {9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 1};
  const Eigen::Vector2d by = displacement(bends, 0, 1, 40, -5);
  EXPECT_DOUBLE_EQ(by.x(), 1 + 2 * 2 + 3 * -1.5 + 4 * 4 + 5 * -3 + 6 * 2.25);
  EXPECT_DOUBLE_EQ(by.y(), 2.25);
  EXPECT_EQ(displacement(bends, 0, 2, 40, -5), Eigen::Vector2d(0, 0))
      << "a sensor that the bend does not know";
}

}  // namespace
}  // namespace lightstripe
