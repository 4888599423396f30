// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/wheelset_contact.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

constexpr double kCone = 0.05, kCrownMm = 300, kHalfMm = 750;

template <class F>
HeightTable table_of(double from, double to, const F& height) {
  HeightTable table{from, 0.1, {}};
  for (int i = 0; from + 0.1 * i <= to + 1e-9; ++i) table.height_mm.push_back(height(from + 0.1 * i));
  return table;
}

/// A cone of 1:20 on a round crown; where the slopes agree, at y = -kCone kCrownMm = -15 on the rail.
WheelOnRail cone_on_crown(double rail_to = 40) {
  return {table_of(-45, 45, [](double y) { return kCone * y; }),
          table_of(-40, rail_to, [](double y) { return -y * y / (2 * kCrownMm); }), kHalfMm, kHalfMm};
}

ContactOptions within(double farthest) {
  ContactOptions options;
  options.farthest_mm = farthest;
  return options;
}

// The roll turns the cone against the crown, which moves the contact: by the slope over the half track times
// the crown the difference of radii is larger.
TEST(WalkWheelset, TwoConesDifferByTwiceTheConeTimesTheShift) {
  const WheelsetWalk walk = walk_wheelset({cone_on_crown(), cone_on_crown()}, within(5));
  ASSERT_TRUE(walk.usable());
  ASSERT_EQ(walk.places.size(), 101U);
  EXPECT_EQ(walk.left_end, ContactEnd::kFarthest);
  const WheelsetPlace &middle = walk.places[50], &right = walk.places[80], &left = walk.places[20];
  EXPECT_NEAR(middle.contact[0].rail_y_mm, -kCone * kCrownMm, 0.02);
  EXPECT_NEAR(middle.radius_difference_mm(), 0, 1e-6);
  EXPECT_NEAR(right.shift_mm, 3, 1e-9);
  EXPECT_NEAR(right.radius_difference_mm(), 2 * kCone * 3 * (1 + kCone * kCrownMm / kHalfMm), 0.003);
  EXPECT_NEAR(left.radius_difference_mm(), -right.radius_difference_mm(), 1e-6);
  EXPECT_NEAR(left.contact[0].wheel_y_mm, right.contact[1].wheel_y_mm, 1e-6);
  EXPECT_NEAR(right.roll_rad, kCone * 3 / kHalfMm, 1e-5);  // the right wheel climbs
}

TEST(WalkWheelset, EndsWhereAProfileEnds) {
  // The wheel shifted outwards touches the rail where its own profile ends at -28.
  WheelOnRail short_wheel = cone_on_crown();
  short_wheel.wheel = table_of(-18, 45, [](double y) { return kCone * y; });
  const WheelsetWalk walk = walk_wheelset({short_wheel, short_wheel}, within(5));
  ASSERT_TRUE(walk.usable());
  EXPECT_EQ(walk.right_end, ContactEnd::kOutside);
  EXPECT_LT(walk.places.back().shift_mm, 3);
  WheelOnRail apart = cone_on_crown();
  apart.rail_origin_mm = 850;
  EXPECT_FALSE(walk_wheelset({apart, apart}, within(5)).usable());
}

TEST(OverlapCentre, OfOneCurvatureIsTheContact) {
  const std::array<WheelOnRail, kSides> sides{cone_on_crown(), cone_on_crown()};
  const WheelsetWalk walk = walk_wheelset(sides, within(1));
  const WheelsetPlace& middle = walk.places[10];
  EXPECT_NEAR(overlap_centre_mm(sides[1], middle, TrackSide::kRight, 0.01), middle.contact[1].rail_y_mm,
              0.02);
}

TEST(FindJumps, LieBetweenTwoShifts) {
  WheelsetWalk walk;
  walk.places.resize(3);
  for (int i = 0; i < 3; ++i) walk.places[static_cast<std::size_t>(i)].shift_mm = 0.1 * (i - 1);
  walk.places[1].contact[1].rail_y_mm = -8;
  walk.places[2].contact[1].rail_y_mm = -20, walk.places[2].contact[1].jumped = true;
  walk.places[0].contact[0].rail_y_mm = 5, walk.places[0].contact[0].jumped = true;
  const std::vector<ContactJump> jumps = find_jumps(walk);
  ASSERT_EQ(jumps.size(), 2U);
  EXPECT_EQ(jumps[1].side, TrackSide::kRight);
  EXPECT_NEAR(jumps[1].shift_mm, 0.05, 1e-12);
  EXPECT_EQ(jumps[1].from_mm, -8);
  EXPECT_EQ(jumps[1].to_mm, -20);
  EXPECT_NEAR(jumps[0].shift_mm, -0.05, 1e-12);  // leftwards
  EXPECT_EQ(jumps[0].to_mm, 5);
}

}  // namespace
}  // namespace lightstripe
