// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What only a whole turn of a wheel can tell.
#include "measure/run_out.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

MeasuredFrame wheel_row(double angle_deg, double radius) {
  MeasuredFrame row;
  row.travel = angle_deg;
  row.extras = {{"radial_deviation", Estimate::known(radius, 0.01)},
                {"axial_deviation", Estimate::unknown("back not seen")}};
  return row;
}

TEST(RunOut, IsHighestLessLowestOfAWholeTurn) {
  std::vector<MeasuredFrame> rows;
  for (int i = 0; i < 36; ++i)
    rows.push_back(wheel_row(10 * i, 460 + 0.15 * std::cos(i * std::numbers::pi / 18)));
  const RunOut run_out = find_run_out(rows);
  ASSERT_TRUE(run_out.radial.value);
  EXPECT_NEAR(*run_out.radial.value, 0.3, 1e-12);
  EXPECT_NEAR(*run_out.radial.sigma, std::sqrt(2.0) * 0.01, 1e-12);
  EXPECT_NEAR(*rows[0].extras[0].estimate.value, 0.15, 1e-9);
  EXPECT_FALSE(run_out.axial.value);
  EXPECT_EQ(run_out.axial.reason, "back not seen");
}

TEST(RunOut, OfPartOfATurnIsNotKnown) {
  std::vector<MeasuredFrame> rows;
  for (int i = 0; i < 30; ++i) rows.push_back(wheel_row(10 * i, 460));
  const RunOut run_out = find_run_out(rows);
  EXPECT_FALSE(run_out.radial.value);
  EXPECT_THAT(run_out.radial.reason, HasSubstr("70 deg of the turn"));
}

}  // namespace
}  // namespace lightstripe
