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

// What is common to all frames falls out of a difference to their mean.
TEST(SectionBends, DoNotCountInDeviationsFromTheScansMean) {
  MeasuredFrame row, bent;
  row.extras = {{"radial_deviation", Estimate::known(460, 0.01)}, {"lip", Estimate::known(1, 0.01)}};
  bent.extras = {{"radial_deviation", Estimate::known(461, 0.01)}, {"lip", Estimate::known(2, 0.01)}};
  add_bends({bent}, row);
  EXPECT_EQ(*row.extras[0].estimate.sigma, 0.01);
  EXPECT_GT(*row.extras[1].estimate.sigma, 1);
}

TEST(SectionBends, CountInTheConicityOfEveryAmplitude) {
  MeasuredFrame row, bent;
  row.conicity = {{1, 0, 0.10, 0.003}, {1.1, 0, std::nullopt, std::nullopt}, {1.2, 0, 0.10, 0.005}};
  bent.conicity = {{1, 0, 0.104, 0}, {1.1, 0, 0.2, 0}, {1.2, 0, 0.112, 0}};
  add_bends({bent}, row);
  EXPECT_NEAR(*row.conicity[0].sigma, 0.005, 1e-12);
  EXPECT_NEAR(*row.conicity[2].sigma, 0.013, 1e-12);
  EXPECT_FALSE(row.conicity[1].sigma);
}

TEST(SectionBends, EachErrorIsMeasuredOnceMoreWhereThereIsSomethingToSee) {
  int measured = 0;
  const auto measure = [&](bool usable) {
    return [&measured, usable](std::optional<std::size_t> error) {
      ++measured;
      MeasuredFrame row = row_of(error ? 1 + 0.1 * static_cast<double>(*error + 1) : 1, 0.0, 5);
      if (usable) row.registration.reason.clear();
      return row;
    };
  };
  const MeasuredFrame row = measure_with_errors(2, measure(true));
  EXPECT_EQ(measured, 3);
  EXPECT_NEAR(*row.estimates[0].estimate.sigma, std::hypot(0.1, 0.2), 1e-12);
  measured = 0;
  measure_with_errors(2, measure(false));
  EXPECT_EQ(measured, 1);
}

TEST(SectionBends, AreBorrowedFromANeighbourThatKnowsAllThatTheRowKnows) {
  const MeasuredFrame plain = row_of(1, 0.3, 5);
  MeasuredFrame neighbour = row_of(1, 0.5, 5), row = row_of(2, 0.1, 5);
  ASSERT_TRUE(borrow_bends(plain, neighbour, row));
  EXPECT_NEAR(*row.estimates[0].estimate.sigma, std::hypot(0.1, 0.4), 1e-12);
  EXPECT_NEAR(*row.extras[0].estimate.sigma, 0.1, 1e-12) << "nothing was added to the neighbour's";
  neighbour.extras[0].estimate = Estimate::unknown("not seen");
  MeasuredFrame other = row_of(2, 0.1, 5);
  EXPECT_FALSE(borrow_bends(plain, neighbour, other));
  EXPECT_EQ(*other.estimates[0].estimate.sigma, 0.1);
  other.extras[0].estimate = Estimate::unknown("not seen");
  EXPECT_TRUE(borrow_bends(plain, neighbour, other)) << "what the row does not know it need not borrow";
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
