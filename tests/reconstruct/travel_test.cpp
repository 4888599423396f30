// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/travel.h"

#include <gtest/gtest.h>

#include "reconstruct/frame_ranges.h"

namespace lightstripe {
namespace {

const TravelReadings kReadings = {{2, 10.0}, {3, 12.0}, {7, 32.0}};

TEST(Travel, AReadingIsTakenAsItStands) {
  const auto position = position_at(kReadings, MotionType::kLinear, 3);
  ASSERT_TRUE(position);
  EXPECT_EQ(position->travel, 12.0);
  EXPECT_FALSE(position->interpolated);
}

TEST(Travel, AGapIsInterpolatedBetweenItsNeighboursAndSaysSo) {
  const auto position = position_at(kReadings, MotionType::kLinear, 4);
  ASSERT_TRUE(position);
  EXPECT_DOUBLE_EQ(position->travel, 17.0);  // a quarter of the way from 12 to 32
  EXPECT_TRUE(position->interpolated);
}

TEST(Travel, NothingIsMadeUpBeyondTheEnds) {
  EXPECT_FALSE(position_at(kReadings, MotionType::kLinear, 1));
  EXPECT_FALSE(position_at(kReadings, MotionType::kLinear, 8));
  EXPECT_FALSE(position_at({}, MotionType::kLinear, 0));
}

TEST(Travel, AnEncoderThatBeganAnewAtAFullTurnIsNotInterpolated) {
  const TravelReadings readings = {{0, 350.0}, {2, 10.0}};
  EXPECT_FALSE(position_at(readings, MotionType::kRotary, 1));
  EXPECT_TRUE(position_at(readings, MotionType::kLinear, 1));
  EXPECT_EQ(position_at(readings, MotionType::kRotary, 2)->travel, 10.0);
}

TEST(FrameRanges, NeighboursBecomeOneRun) {
  FrameRanges ranges;
  for (const int frame : {3, 4, 5, 9, 12, 13}) ranges.add(frame);
  EXPECT_EQ(ranges.count, 6);
  EXPECT_EQ(ranges.text(), "3 to 5, 9, 12 to 13");
  EXPECT_EQ(ranges.text(2), "3 to 5, 9, ...");
  EXPECT_THROW(ranges.add(13), std::logic_error);
}

}  // namespace
}  // namespace lightstripe
