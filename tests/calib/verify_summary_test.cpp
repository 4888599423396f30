// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sums over views, by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/verify/verify_rig.h"

namespace lightstripe {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

VerifiedView view(const std::string& sensor, double corner, double plane, double length_error, int points) {
  VerifiedView v;
  v.sensor = sensor;
  v.corner_rms_px = corner, v.plane_rms_mm = plane, v.length_error_mm = length_error;
  v.stripe_points = points, v.length_mm = points > 0 ? 80 : 0;
  return v;
}

Verification two_sensors() {
  Verification all;
  all.views = {view("a", 0.3, 0.03, 0.1, 50), view("a", 0.4, 0.04, -0.1, 50), view("a", 0.5, 9, 9, 0),
               view("b", 0.1, 0.02, 0, 10)};
  all.pairs = {{"a", "b", "0", 0.3, 0.5}, {"a", "b", "1", std::nullopt, 0.5}, {"a", "b", "2", 0.4, 0.5}};
  return all;
}

TEST(VerifySummary, RootMeanSquaresOfViewsWithAStripe) {
  const auto sensors = by_sensor(two_sensors());
  ASSERT_EQ(sensors.size(), 2u);
  EXPECT_EQ(sensors[0].views, 2);  // a view without stripe has corners only
  EXPECT_NEAR(sensors[0].corner_rms_px, std::sqrt((0.09 + 0.16 + 0.25) / 3), 1e-12);
  EXPECT_NEAR(sensors[0].plane_rms_mm, std::sqrt((0.0009 + 0.0016) / 2), 1e-12);
  EXPECT_NEAR(sensors[0].length_error_mm, 0.1, 1e-12);
  const auto seams = by_seam(two_sensors());
  ASSERT_EQ(seams.size(), 1u);
  EXPECT_EQ(seams[0].poses, 3);
  EXPECT_NEAR(seams[0].gap_mm, std::sqrt((0.09 + 0.16) / 2), 1e-12);
  EXPECT_NEAR(seams[0].centre_gap_mm, 0.5, 1e-12);
}

TEST(VerifySummary, OnlyLimitsThatAreGivenAreExceeded) {
  EXPECT_THAT(exceeded(two_sensors(), {}), ElementsAre());
  VerifyLimits limits;
  limits.max_plane_rms_mm = 0.03, limits.max_gap_mm = 0.4;
  EXPECT_THAT(exceeded(two_sensors(), limits),
              ElementsAre(HasSubstr("a: stripe off the board's plane: 0.035 mm")));
  limits.max_gap_mm = 0.3;
  EXPECT_THAT(
      exceeded(two_sensors(), limits),
      ElementsAre(HasSubstr("a: "), HasSubstr("gap between a and b: 0.354 mm, the limit is 0.300 mm")));
}

}  // namespace
}  // namespace lightstripe
