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

TEST(WornWheel, FlangeWearThinsTheFlangeByItsAmountAndSparesTheTip) {
  const Outline worn = worn_wheel(read_nominal("S1002"), {2.0, 0});
  const WheelDimensions size = measure_wheel_section(worn);
  EXPECT_NEAR(size.flange_thickness, 30.5, 1e-3);
  EXPECT_NEAR(size.flange_height, 28.0, 1e-3);
  // By hand: 2 below the tip the nominal face stands at -55 + sqrt(12^2 - 10^2), and the wear has faded to
  // 2 (1 - t^2 (3 - 2 t)) at t = (26 - 12) / (28 - 12); 10 above the datum it is whole.
  const double t = 14.0 / 16.0, faded = 2 * (1 - t * t * (3 - 2 * t));
  EXPECT_NEAR(size.qr, 10.794 - 2 + faded, 2e-3);
}

TEST(WornWheel, WornFaceIsAsSmoothAsTheNominalOne) {
  const Outline worn = worn_wheel(read_nominal("S1002"), {2.0, 1.5});
  const std::vector<OutlineSample> points = sample(worn, 0.05);
  double sharpest = 0;  // turn between neighbours on flange and tread; an edge would turn by tens of degrees
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vector2d before = points[i].position - points[i - 1].position;
    const Vector2d after = points[i + 1].position - points[i].position;
    if (points[i].position.y() < -2 || points[i].position.x() < -69) continue;
    const double cross = before.x() * after.y() - before.y() * after.x();
    sharpest = std::max(sharpest, std::abs(std::atan2(cross, before.dot(after))));
  }
  EXPECT_LT(sharpest, 0.02);  // 0.05 mm of R12 turn by 0.004, of R5 by 0.01
}

TEST(WornWheel, MuchFlangeWearLeavesAnUprightFaceAndNoOverhang) {
  const Outline worn = worn_wheel(read_nominal("S1002"), {9.0, 0});
  EXPECT_NEAR(measure_wheel_section(worn).flange_thickness, 23.5, 1e-3);
  const std::vector<OutlineSample> points = sample(worn, 0.05);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].position.y() < 0 || points[i - 1].position.x() < -54.9) continue;
    EXPECT_LE(points[i].position.x(), points[i - 1].position.x() + 1e-9);  // field side to tip
  }
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
