// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/exclusion_mask.h"

#include <gtest/gtest.h>

#include <vector>

namespace lightstripe {
namespace {

TEST(ExclusionMask, MarksCellsWithinReachAndNoFurther) {
  ExclusionMask mask;
  mask.reset(64, 48, 0);
  mask.mark_column(10, 20, 3.2, 7);
  EXPECT_EQ(mask(10, 20), 7);
  EXPECT_EQ(mask(10, 17), 7);
  EXPECT_EQ(mask(10, 23), 7);
  EXPECT_EQ(mask(10, 25), ExclusionMask::kFree);
  EXPECT_EQ(mask(11, 20), ExclusionMask::kFree);
  mask.mark_row(5, 0, 4, 9);  // beyond the border is cut
  EXPECT_EQ(mask(0, 5), 9);
  EXPECT_EQ(mask(4, 5), 9);
}

TEST(ExclusionMask, TheFirstLineKeepsItsCells) {
  ExclusionMask mask;
  mask.reset(64, 48, 0);
  mask.mark_row(8, 20, 4, 1);
  mask.mark_row(8, 23, 4, 2);
  EXPECT_EQ(mask(21, 8), 1);
  EXPECT_EQ(mask(26, 8), 2);
}

TEST(ExclusionMask, RelabelsWhatWasMarkedSinceTheCheckpoint) {
  ExclusionMask mask;
  mask.reset(64, 48, 1);
  mask.mark_row(8, 10, 4, 3);
  const auto checkpoint = mask.checkpoint();
  mask.mark_row(20, 10, 4, 3);
  mask.mark_row(30, 10, 4, 4);
  mask.relabel(checkpoint, 3, 3, ExclusionMask::kDead);
  EXPECT_EQ(mask(10, 8), 3);
  EXPECT_EQ(mask(10, 20), ExclusionMask::kDead);
  EXPECT_EQ(mask(10, 30), 4);
  mask.reset(64, 48, 1);
  EXPECT_EQ(mask(10, 8), ExclusionMask::kFree);
}

TEST(ExclusionMask, WhatWasLiftedStandsAgainAsItDid) {
  ExclusionMask mask;
  mask.reset(64, 48, 0);
  mask.mark_row(8, 10, 4, 3);
  const auto checkpoint = mask.checkpoint();
  mask.mark_row(8, 14, 4, 5);  // its left part is the first line's
  mask.mark_row(9, 14, 4, 6);
  std::vector<ExclusionMask::Mark> lifted;
  mask.lift(checkpoint, 5, 6, lifted);
  EXPECT_EQ(mask(12, 8), 3);
  EXPECT_EQ(mask(17, 8), ExclusionMask::kFree);
  EXPECT_EQ(mask(17, 9), ExclusionMask::kFree);
  const auto another = mask.checkpoint();
  mask.mark_row(9, 14, 2, 7);  // a try in its place, which fails
  mask.relabel(another, 7, 7, ExclusionMask::kDead);
  mask.put_back(lifted);
  EXPECT_EQ(mask(12, 8), 3);
  EXPECT_EQ(mask(17, 8), 5);
  EXPECT_EQ(mask(14, 9), 6);
  mask.relabel(checkpoint, 5, 7, ExclusionMask::kFree);  // and can be taken back for good
  EXPECT_EQ(mask(17, 8), ExclusionMask::kFree);
  EXPECT_EQ(mask(14, 9), ExclusionMask::kFree);
  EXPECT_EQ(mask(12, 8), 3);
}

}  // namespace
}  // namespace lightstripe
