// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/track/look_through.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

void add_bar(Image8& image, int left, int right, int top, int height) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < right; ++x) image(x, y) = 150;
}

/// One line at y = 100 in the earlier frame.
TrackReference line_before() {
  TrackReference before;
  before.width = 640, before.height = 480, before.sigma = 2;
  for (int x = 100; x <= 500; x += 8) before.places.push_back({static_cast<float>(x), 100});
  before.line_ends = {before.places.size()};
  return before;
}

Stripe stripe_at(double y, int from, int to) {
  Stripe stripe;
  for (int x = from; x < to; ++x) {
    StripePoint& p = stripe.points.emplace_back();
    p.x = x, p.y = y, p.normal_y = 1;
  }
  return stripe;
}

TEST(LookThrough, OpensWhereLinesWereAndWhereALongOneAppears) {
  Image8 image(640, 480, 10);
  add_bar(image, 100, 500, 98, 5);
  add_bar(image, 200, 420, 298, 5);  // new
  add_bar(image, 560, 568, 400, 8);  // a spot
  TrackWorkspace w;
  const auto facts = look_through(image.view(), line_before(), 60, w);
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->histogram.largest, 150);
  EXPECT_TRUE(w.windows.is_open(300, 100));
  EXPECT_TRUE(w.windows.is_open(300, 300));
  EXPECT_FALSE(w.windows.is_open(564, 404));
  EXPECT_FALSE(w.windows.is_open(300, 200));
}

TEST(LookThrough, WhereMostIsOpenTheFullSearchIsNoDearer) {
  Image8 image(640, 480, 10);
  TrackReference before = line_before();
  for (int y = 20; y < 460; y += 20)
    for (int x = 0; x < 640; x += 8) before.places.push_back({static_cast<float>(x), static_cast<float>(y)});
  TrackWorkspace w;
  EXPECT_FALSE(look_through(image.view(), before, 60, w));
}

TEST(NoiseOfLevels, FallsByHalfOrAsMuchAsBefore) {
  TrackReference before;
  const LevelNoise white = noise_of_levels(before, 4);
  EXPECT_EQ(white[0], 4);
  EXPECT_EQ(white[1], 2);
  EXPECT_EQ(white[3], 0.5);
  before.noise = {2, 1.5, 0.4, 1};
  const LevelNoise grainy = noise_of_levels(before, 4);  // twice as noisy as before
  EXPECT_EQ(grainy[1], 3);
  EXPECT_EQ(grainy[2], 1);
  EXPECT_EQ(grainy[3], 2);
}

TEST(CoarsestLevel, FollowsTheWidestLine) {
  TrackReference before;
  for (const auto& [sigma, level] : {std::pair{0.5, 1}, {1.0, 1}, {2.0, 2}, {4.0, 3}, {20.0, 3}}) {
    before.sigma = sigma;
    EXPECT_EQ(coarsest_level(before), level) << sigma;
  }
}

TEST(HasAllLines, HalfOfEachLineIsEnough) {
  Image8 image(640, 480, 10);
  add_bar(image, 100, 500, 98, 5);
  TrackWorkspace w;
  const TrackReference before = line_before();
  ASSERT_TRUE(look_through(image.view(), before, 60, w));
  EXPECT_TRUE(has_all_lines(before, {stripe_at(100, 100, 500)}, w));
  EXPECT_TRUE(has_all_lines(before, {stripe_at(100, 240, 500)}, w));
  EXPECT_FALSE(has_all_lines(before, {stripe_at(100, 400, 500)}, w));
  EXPECT_FALSE(has_all_lines(before, {}, w));
  EXPECT_FALSE(has_all_lines(before, {stripe_at(100, 100, 500), stripe_at(300, 200, 260)}, w));  // unseen
}

}  // namespace
}  // namespace lightstripe
