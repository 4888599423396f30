// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/track/search_windows.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

TEST(SearchWindows, OpenWithinTheMarginClosedElsewhere) {
  SearchWindows windows;
  windows.reset(320, 200);
  windows.open(100, 50, 12);
  windows.settle();
  for (const double d : {-12.0, 0.0, 12.0}) EXPECT_TRUE(windows.is_open(100 + d, 50)) << d;
  EXPECT_FALSE(windows.is_open(100 + 12 + 2 * 8, 50));  // a cell is eight pixels
  EXPECT_FALSE(windows.is_open(100, 90));
  EXPECT_FALSE(windows.is_open(-5, 50));
  ASSERT_EQ(windows.spans(50).size(), 1u);
  EXPECT_LE(windows.spans(50)[0].begin, 88);
  EXPECT_GE(windows.spans(50)[0].end, 113);
  EXPECT_TRUE(windows.spans(150).empty());
  EXPECT_TRUE(windows.spans(-1).empty());
  EXPECT_LT(windows.open_share(), 0.05);
}

TEST(SearchWindows, WidenedByCellsAndCutAtTheBorder) {
  SearchWindows narrow, wide;
  narrow.reset(320, 200);
  narrow.open(2, 2, 1);
  narrow.settle();
  wide.reset(320, 200);
  wide.widen(narrow, 2);
  EXPECT_TRUE(wide.is_open(2, 2));
  EXPECT_TRUE(wide.is_open(20, 20));
  EXPECT_FALSE(wide.is_open(30, 2));
  EXPECT_EQ(wide.spans(2)[0].begin, 0);
}

}  // namespace
}  // namespace lightstripe
