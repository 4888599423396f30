// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/accuracy_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(AccuracyTable, HasARowForWhatIsKnown) {
  RigError rig;
  rig.sensors = {{"gauge", 0.012, 0.034, 0}};
  rig.travel_deg = 0.05;
  CloudError cloud;
  cloud.shape_rms_mm = 0.0123, cloud.recovered_fraction = 0.987;
  const std::string table = accuracy_table(rig, cloud, {{"vertical_wear", 0.0161, 0.04, 0.001, 12}}, false);
  EXPECT_THAT(table, HasSubstr("laser plane of gauge, direction"));
  EXPECT_THAT(table, HasSubstr("0.0123 mm |"));
  EXPECT_THAT(table, HasSubstr("98.7 % |"));
  EXPECT_THAT(table, HasSubstr("vertical wear of 12 sections, rms"));
  EXPECT_THAT(table, Not(HasSubstr("sensor to sensor")));  // there is one sensor
  EXPECT_THAT(table, Not(HasSubstr("axis")));
  EXPECT_NE(table.back(), '\n');
}

TEST(AccuracyTable, AWheelHasAnAxisAndOneDiameter) {
  RigError rig;
  rig.axis_mm = 0.2;
  const std::string table = accuracy_table(rig, {}, {{"diameter", 0.5, 0.9, -0.031, 40}}, true);
  EXPECT_THAT(table, HasSubstr("axis, place"));
  EXPECT_THAT(table, HasSubstr("0.031 mm |"));
  EXPECT_THAT(table, Not(HasSubstr("diameter of 40")));
}

}  // namespace
}  // namespace lightstripe
