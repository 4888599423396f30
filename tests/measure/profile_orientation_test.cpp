// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/profile_orientation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// A block of a wheel over the distance from the flange's back: flange 28 mm over the tread, chamfer.
double height_at(double from_back) { return from_back < 32 ? 28 : from_back > 125 ? -4 : 0; }

/// `x_of` and `sign` say how the file has it.
template <class F>
RecordedProfile wheel(const F& x_of, double sign) {
  RecordedProfile profile;
  profile.kind = ObjectKind::kWheel;
  for (double d = 0; d <= 135; d += 0.5) profile.points.emplace_back(x_of(d), sign * height_at(d));
  return profile;
}

void expect_upright(RecordedProfile profile) {
  turn_upright(profile);
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const double from_back = 0.5 * static_cast<double>(i);
    EXPECT_NEAR(profile.points[i].x(), from_back - 70, 1e-9);
    EXPECT_NEAR(profile.points[i].y(), height_at(from_back), 1e-9);
  }
}

TEST(TurnUpright, WheelsThatCountFromTheBack) {
  for (const double sign : {1.0, -1.0}) {
    expect_upright(wheel([](double d) { return d; }, sign));
    expect_upright(wheel([](double d) { return -d; }, sign));
  }
}

TEST(TurnUpright, WheelsThatCountFromTheDatum) {
  for (const double sign : {1.0, -1.0}) {
    expect_upright(wheel([](double d) { return d - 70; }, sign));
    expect_upright(wheel([](double d) { return 70 - d; }, sign));
  }
}

TEST(TurnUpright, ARailsTopIsAboveItsSides) {
  for (const double sign : {1.0, -1.0}) {
    RecordedProfile rail;
    rail.kind = ObjectKind::kRail;
    for (double x = -36; x <= 36; x += 0.5)
      rail.points.emplace_back(x, sign * (std::abs(x) > 33 ? -14 : -x * x / 600));
    turn_upright(rail);
    EXPECT_NEAR(rail.points.front().y(), -14, 1e-9);
    EXPECT_EQ(rail.points.front().x(), -36);
  }
}

}  // namespace
}  // namespace lightstripe
