// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/worn_wheel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/nominal_outlines.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

TEST(WornWheel, UnwornS1002HasThePublishedDimensions) {
  const WheelDimensions size = measure_wheel_section(worn_wheel(read_nominal("S1002"), {}));
  EXPECT_NEAR(size.flange_height, 28.000, 5e-4);
  EXPECT_NEAR(size.flange_thickness, 32.500, 5e-4);
  EXPECT_NEAR(size.qr, 10.794, 5e-4);
  EXPECT_NEAR(size.rim_width, 135.0, 1e-9);
  EXPECT_NEAR(size.hollow, 0.0, 1e-6);
}

TEST(WornWheel, TreadWearRaisesTheFlangeByWhatTheTreadHasSunk) {
  const Outline nominal = read_nominal("S1002");
  const WheelDimensions size = measure_wheel_section(worn_wheel(nominal, {0, 1.5}));
  EXPECT_NEAR(size.flange_height, 29.5, 1e-3);
  EXPECT_GT(size.hollow, 0.3);  // 1.5 deep over a half width of 30 on a slope of 1:40, by eye
  EXPECT_LT(size.hollow, 1.5);
}

TEST(WornWheel, FlangeWearThinsTheFlangeByItsAmount) {
  // 10 mm above the datum the face has moved by the full amount; the tip becomes the meeting of two arcs R12
  // whose centres are 2 mm apart: lower by 12 - sqrt(12^2 - 1) = 0.0417.
  const WheelDimensions size = measure_wheel_section(worn_wheel(read_nominal("S1002"), {2.0, 0}));
  EXPECT_NEAR(size.flange_thickness, 30.5, 1e-3);
  EXPECT_NEAR(size.flange_height, 28 - 0.0417, 1e-3);
}

TEST(WornWheel, OnlyTakesMaterialAway) {
  const Outline nominal = read_nominal("S1002"), worn = worn_wheel(nominal, {3.0, 2.0});
  EXPECT_TRUE(worn.closed());
  for (const OutlineSample& point : sample(worn, 0.5)) {
    const bool inside =
        contains(nominal, point.position) || closest_point(nominal, point.position).distance < 1e-4;
    EXPECT_TRUE(inside) << point.position.transpose();
  }
}

TEST(WornWheel, WhatIsNoWheelIsAnError) { EXPECT_ANY_THROW(worn_wheel(read_nominal("S1002"), {13, 0})); }

}  // namespace
}  // namespace lightstripe
