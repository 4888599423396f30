// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/frames_ahead.h"

#include <gtest/gtest.h>

#include <vector>

namespace lightstripe {
namespace {

TEST(FramesAhead, NothingIsAskedForWhatIsInMemory) {
  FramesAhead ahead;
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(ahead.after(i, true).empty());
}

TEST(FramesAhead, OfASlowDiskEachFrameIsAskedForOnceAndInTime) {
  FramesAhead ahead;
  std::vector<int> asked(1000, 0);
  int waited = 0;
  for (int i = 0; i < 500; ++i) {
    const bool cached = asked[static_cast<std::size_t>(i)] > 0;
    waited += cached ? 0 : 1;
    const auto next = ahead.after(i, cached);
    for (auto k = next.begin; k < next.end; ++k) ++asked[static_cast<std::size_t>(k)];
  }
  EXPECT_LE(waited, 1 + 500 / 64);
  for (int i = 0; i < 500; ++i) EXPECT_LE(asked[static_cast<std::size_t>(i)], 1) << i;
}

TEST(FramesAhead, StopsWhereTheRestIsInMemory) {
  FramesAhead ahead;
  EXPECT_EQ(ahead.after(0, false).end, 9);
  std::int64_t asked = 9;
  for (int i = 1; i < 200; ++i) asked = std::max(asked, ahead.after(i, true).end);
  EXPECT_LT(asked, 80);
}

}  // namespace
}  // namespace lightstripe
