// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/exclusion_mask.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace lightstripe {
namespace {

constexpr auto kFree = ExclusionMask::kFree, kDead = ExclusionMask::kDead;

ExclusionMask free_mask(int cell_shift) {
  ExclusionMask mask;
  mask.reset(64, 48, cell_shift);
  return mask;
}

struct Labelled {
  int x, y;
  std::uint16_t label;
};

void expect_labels(const ExclusionMask& mask, const std::vector<Labelled>& wanted) {
  for (const auto& [x, y, label] : wanted) EXPECT_EQ(mask(x, y), label) << x << ' ' << y;
}

TEST(ExclusionMask, MarksCellsWithinReachAndNoFurther) {
  ExclusionMask mask = free_mask(0);
  mask.mark_column(10, 20, 3.2, 7);
  expect_labels(mask, {{10, 20, 7}, {10, 17, 7}, {10, 23, 7}, {10, 25, kFree}, {11, 20, kFree}});
  mask.mark_row(5, 0, 4, 9);  // beyond the border is cut
  expect_labels(mask, {{0, 5, 9}, {4, 5, 9}});
}

TEST(ExclusionMask, TheFirstLineKeepsItsCells) {
  ExclusionMask mask = free_mask(0);
  mask.mark_row(8, 20, 4, 1);
  mask.mark_row(8, 23, 4, 2);
  expect_labels(mask, {{21, 8, 1}, {26, 8, 2}});
}

TEST(ExclusionMask, RelabelsWhatWasMarkedSinceTheCheckpoint) {
  ExclusionMask mask = free_mask(1);
  mask.mark_row(8, 10, 4, 3);
  const auto checkpoint = mask.checkpoint();
  mask.mark_row(20, 10, 4, 3);
  mask.mark_row(30, 10, 4, 4);
  mask.relabel(checkpoint, 3, 3, kDead);
  expect_labels(mask, {{10, 8, 3}, {10, 20, kDead}, {10, 30, 4}});
  mask.reset(64, 48, 1);
  expect_labels(mask, {{10, 8, kFree}});
}

TEST(ExclusionMask, WhatWasLiftedStandsAgainAsItDid) {
  ExclusionMask mask = free_mask(0);
  mask.mark_row(8, 10, 4, 3);
  const auto checkpoint = mask.checkpoint();
  mask.mark_row(8, 14, 4, 5);  // its left part is the first line's
  mask.mark_row(9, 14, 4, 6);
  std::vector<ExclusionMask::Mark> lifted;
  mask.lift(checkpoint, 5, 6, lifted);
  expect_labels(mask, {{12, 8, 3}, {17, 8, kFree}, {17, 9, kFree}});
  const auto another = mask.checkpoint();
  mask.mark_row(9, 14, 2, 7);  // a try in its place, which fails
  mask.relabel(another, 7, 7, kDead);
  mask.put_back(lifted);
  expect_labels(mask, {{12, 8, 3}, {17, 8, 5}, {14, 9, 6}});
  mask.relabel(checkpoint, 5, 7, kFree);  // and can be taken back for good
  expect_labels(mask, {{17, 8, kFree}, {14, 9, kFree}, {12, 8, 3}});
}

}  // namespace
}  // namespace lightstripe
