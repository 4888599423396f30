// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/section_bends.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

MeasuredFrame row_of(double wear, std::optional<double> sigma, double lip) {
  MeasuredFrame row;
  row.estimates = {{"vertical_wear", {wear, sigma, ""}}, {"side_wear", Estimate::unknown("not seen")}};
  row.extras = {{"lip", Estimate::known(lip, 0.1)}};
  return row;
}

TEST(SectionBends, CountInQuadratureWithWhatTheScatterSays) {
  MeasuredFrame row = row_of(1, 0.3, 5);
  MeasuredFrame unknown = row_of(1, 0.3, 5);
  unknown.estimates[0].estimate = Estimate::unknown("lost");
  add_bends({row_of(1.4, 0.3, 5), row_of(1, 0.3, 5.2), unknown}, row);
  EXPECT_NEAR(*row.estimates[0].estimate.sigma, 0.5, 1e-12);
  EXPECT_FALSE(row.estimates[1].estimate.sigma);
  EXPECT_NEAR(*row.extras[0].estimate.sigma, std::hypot(0.1, 0.2), 1e-12);
}

TEST(SectionBends, AnUnknownSigmaStaysUnknown) {
  MeasuredFrame row = row_of(1, std::nullopt, 5);
  add_bends({row_of(2, std::nullopt, 5)}, row);
  EXPECT_FALSE(row.estimates[0].estimate.sigma);
}

TEST(SectionBends, MoveEachSensorsPointsInTheSection) {
  Profile profile;
  profile.points.resize(2);
  profile.points[0].u = 110, profile.points[0].v = 0, profile.points[0].sensor = 0;
  profile.points[1].u = 110, profile.points[1].v = 0, profile.points[1].sensor = 1;
  SectionBends bends{{10, 0}, 100, {std::vector<double>(24, 0.0)}};
  bends.bends[0][12] = 0.5, bends.bends[0][18 + 3] = 0.25;  // sensor 1: y by 0.5, z by 0.25 a^2
  const Profile moved = bent(profile, bends, 0);
  EXPECT_EQ(moved.points[0].u, 110);
  EXPECT_EQ(moved.points[0].v, 0);
  EXPECT_EQ(moved.points[1].u, 110.5);
  EXPECT_EQ(moved.points[1].v, 0.25);
}

}  // namespace
}  // namespace lightstripe
