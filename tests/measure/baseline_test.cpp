// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Earlier scans as references.
#include "measure/baseline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "estimates.h"
#include "io/nominal_outlines.h"
#include "sections.h"
#include "simulate/worn_rail.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

class EarlierScan : public ::testing::Test {
 protected:
  const Outline nominal = read_nominal("60E1");
  const ReferenceShape reference{"60E1", ObjectKind::kRail, nominal};
};

// Noise 0.01 per point: medians of some seven points of the baseline 0.005, the fit's own 0.003.
TEST_F(EarlierScan, WearIsWhatWasLostSince) {
  const Profile earlier = profile_of(
      rail_section(worn_rail(nominal, 1.0, 0.5), {.noise_mm = 0.01, .turn_deg = 1, .shift = {5, -250}}));
  const Baseline baseline({earlier}, reference, {}, {}, "earlier");
  const Profile now = profile_of(rail_section(
      worn_rail(nominal, 1.6, 1.1), {.noise_mm = 0.01, .turn_deg = 2, .shift = {9, -251}, .seed = 2}));
  const ReferenceShape* const shape = baseline.at(1e6);  // the only one
  ASSERT_NE(shape, nullptr);
  EXPECT_EQ(shape->name(), "60E1 baseline");
  const MeasuredFrame row = measure_profile(now, {*shape, {}, {}}, {});
  EXPECT_EQ(row.status, "ok");
  EXPECT_NEAR(*estimate_of(row, "vertical_wear").value, 0.6, 0.02);
  EXPECT_NEAR(*estimate_of(row, "side_wear").value, 0.6, 0.03);
  EXPECT_NEAR(*estimate_of(row, "head_width").value, 71.963 - 1.1 + 0.1 * 1.6, 0.06);  // is no difference
}

TEST_F(EarlierScan, EachSectionIsComparedWithTheOneNearestInTravel) {
  std::vector<Profile> profiles;
  for (const double travel : {0.0, 10.0, 20.0})
    profiles.push_back(profile_of(rail_section(worn_rail(nominal, travel / 10, 0), {}), travel));
  const Baseline baseline(profiles, reference, {}, {}, "earlier");
  ASSERT_EQ(baseline.size(), 3U);
  EXPECT_NEAR(baseline.at(-3)->top_v(), 0, 0.01);
  EXPECT_NEAR(baseline.at(14)->top_v(), -1, 0.01);
  EXPECT_EQ(baseline.at(60), nullptr);
}

TEST_F(EarlierScan, WhatLiesOnNoRailIsNoBaseline) {
  Section circle;
  for (int i = 0; i < 300; ++i)
    circle.push_back({Vector2d(60 * std::cos(i * 0.02), 60 * std::sin(i * 0.02)), 0, 0, 0, 1});
  EXPECT_THROW(Baseline({profile_of(circle)}, reference, {}, {}, "circle.csv"), Error);
}

}  // namespace
}  // namespace lightstripe
