// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/counted.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace lightstripe {
namespace {

TEST(Counted, OnlyOneIsSingular) {
  EXPECT_EQ(counted(0, "frame"), "0 frames");
  EXPECT_EQ(counted(1, "frame"), "1 frame");
  EXPECT_EQ(counted(std::size_t{2}, "frame"), "2 frames");
}

TEST(Counted, AVerbAgreesWithItsCount) {
  EXPECT_EQ(counted(1, "frame has no position", "frames have no position"), "1 frame has no position");
  EXPECT_EQ(counted(4, "frame has no position", "frames have no position"), "4 frames have no position");
}

TEST(Counted, ANounStandsAloneWhereTheCountDoes) {
  EXPECT_EQ(noun_of(1, "stripe lies", "stripes lie"), "stripe lies");
  EXPECT_EQ(noun_of(7, "stripe lies", "stripes lie"), "stripes lie");
}

}  // namespace
}  // namespace lightstripe
