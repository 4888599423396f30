// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/hand_over.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

/// A line along x from `from` on, step +1 or -1, its normals on the side of +y.
void add_line(LineSet& lines, double from, double step, double y, std::size_t count) {
  const std::size_t begin = lines.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    StripePoint& p = lines.points.emplace_back();
    p.x = from + step * static_cast<double>(i), p.y = y, p.normal_y = 1;
  }
  lines.lines.push_back({begin, lines.points.size()});
}

class HandOver : public ::testing::Test {
 protected:
  HandOver() {
    add_line(w.groups.add(kernels).lines, 10, 1, 1, 3);
    LineSet& second = w.groups.add(kernels).lines;
    add_line(second, 20, -1, 2, 5);
    add_line(second, 30, 1, 3, 4);
  }
  DerivativeKernels kernels = make_derivative_kernels(1.5);
  ExtractionWorkspace w;
  ExtractionResult result;
};

TEST_F(HandOver, LongestFirstWithGrowingX) {
  hand_over(w, 0, {}, result);
  ASSERT_EQ(result.stripes.size(), 3U);
  EXPECT_EQ(result.stripes[0].points.size(), 5U);
  EXPECT_EQ(result.stripes[1].points.size(), 4U);
  EXPECT_EQ(result.stripes[2].points.size(), 3U);
  EXPECT_EQ(result.stripes[0].points.front().x, 16);  // it was followed the other way
  EXPECT_EQ(result.stripes[0].points.back().x, 20);
  EXPECT_EQ(result.stripes[0].points.front().normal_y, -1);
  EXPECT_EQ(result.stripes[1].points.front().normal_y, 1);
}

TEST_F(HandOver, TheRegionsOriginIsAddedAndMaxLinesKept) {
  hand_over(w, 2, {100, 50}, result);
  ASSERT_EQ(result.stripes.size(), 2U);
  EXPECT_EQ(result.stripes[1].points.front().x, 130);
  EXPECT_EQ(result.stripes[1].points.front().y, 53);
}

TEST_F(HandOver, MemoryOfStripesThatAreNotNeededComesBack) {
  hand_over(w, 0, {}, result);
  const StripePoint* const memory = result.stripes[2].points.data();
  resize_stripes(2, w, result.stripes);
  EXPECT_EQ(w.spare.size(), 1U);
  hand_over(w, 0, {}, result);
  EXPECT_TRUE(w.spare.empty());
  EXPECT_EQ(result.stripes[2].points.data(), memory);
}

}  // namespace
}  // namespace lightstripe
