// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/patience.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

/// Points along y = 100 from x = 0 on.
std::vector<StripePoint> straight_line(int length) {
  std::vector<StripePoint> points(static_cast<std::size_t>(length));
  for (int x = 0; x < length; ++x) {
    points[static_cast<std::size_t>(x)].x = x;
    points[static_cast<std::size_t>(x)].y = 100;
  }
  return points;
}

SearchPatience patience_of(int width, int height) {
  SearchPatience patience;
  patience.reset(width, height, FollowTuning{});
  return patience;
}

TEST(SearchPatience, LastsUntilManyPointsWereInVain) {
  SearchPatience patience = patience_of(400, 300);
  patience.add_futile(2.9 * 700);
  EXPECT_FALSE(patience.is_over());
  patience.add_futile(0.2 * 700);
  EXPECT_TRUE(patience.is_over());
}

TEST(SearchPatience, IsShorterOnceALineIsFound) {
  SearchPatience patience = patience_of(400, 300);
  patience.add_futile(1.1 * 700);
  EXPECT_FALSE(patience.is_over());
  patience.add_line(straight_line(150), 4);
  EXPECT_FALSE(patience.is_over()) << "half of it may be missing";
  patience.add_line(straight_line(150), 4);
  EXPECT_TRUE(patience.is_over());
}

TEST(SearchPatience, GoesOnBesideTheEndsForAWhile) {
  SearchPatience patience = patience_of(400, 300);
  patience.add_line(straight_line(300), 4);
  patience.add_futile(1.1 * 700);
  patience.look_beside_ends();
  EXPECT_FALSE(patience.is_over());
  patience.add_futile(0.5 * 700);
  EXPECT_TRUE(patience.is_over());
}

TEST(SearchPatience, KnowsWhereALineMayGoOn) {
  SearchPatience patience = patience_of(400, 300);
  EXPECT_FALSE(patience.is_beside_end(310, 100));
  patience.add_line(straight_line(300), 4);
  EXPECT_EQ(patience.lines(), 1U);
  EXPECT_TRUE(patience.is_beside_end(304, 95)) << "around a corner";
  EXPECT_TRUE(patience.is_beside_end(330, 105)) << "straight on";
  EXPECT_TRUE(patience.is_beside_end(-20, 103)) << "at the other end";
  EXPECT_FALSE(patience.is_beside_end(330, 120)) << "aside";
  EXPECT_FALSE(patience.is_beside_end(380, 100)) << "too far";
  EXPECT_FALSE(patience.is_beside_end(150, 100)) << "beside its middle";
}

TEST(SearchPatience, ForgetsTheLastPicture) {
  SearchPatience patience = patience_of(400, 300);
  patience.add_line(straight_line(300), 4);
  patience.add_futile(1e6);
  patience.reset(400, 300, FollowTuning{});
  EXPECT_FALSE(patience.is_over());
  EXPECT_FALSE(patience.is_beside_end(330, 100));
}

}  // namespace
}  // namespace lightstripe
