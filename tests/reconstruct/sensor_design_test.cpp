// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/sensor_design.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "reconstruct/triangulate.h"

namespace lightstripe {
namespace {

// By hand: sin 30 = 0.5, f = 1000 px, D = 400 mm. In the middle 400 / 1000 = 0.4 mm a pixel along the stripe,
// 0.4 / 0.5 = 0.8 mm of height a pixel. 500 rows: slope 0.25 at the edge; near 0.25 * 400 / (0.5 + 0.25 *
// 0.866025) = 139.56 mm, far -100 / (0.5 - 0.216506) = -352.75 mm.
TEST(SensorDesign, AgreesWithHandComputedValues) {
  const DesignAnswer answer = design_sensor({400, 30, 1000, 800, 500, 0.1});
  EXPECT_NEAR(answer.middle.along_mm_px, 0.4, 1e-12);
  EXPECT_NEAR(answer.middle.across_mm_px, 0.8, 1e-12);
  EXPECT_NEAR(answer.middle.sigma_mm, 0.08, 1e-12);
  EXPECT_NEAR(answer.middle.width_mm, 320, 1e-9);
  EXPECT_NEAR(answer.near.height_mm, 139.56, 0.01);
  EXPECT_NEAR(answer.far.height_mm, -352.75, 0.01);
  EXPECT_NEAR(answer.range_mm, 492.31, 0.02);
  // Near: depth 400 - 139.56 * 0.866025 = 279.14 mm, 279.14^2 / (1000 * 400 * 0.5) = 0.38960 mm a pixel.
  EXPECT_NEAR(answer.near.across_mm_px, 0.38960, 1e-4);
}

// The demo's gauge sensor: 549 mm away under 40 degrees, 1641 px. Issue 16's example.
TEST(SensorDesign, TheExampleOfTheDocs) {
  const DesignAnswer answer = design_sensor({550, 40, 1640, 960, 700, 0.05});
  EXPECT_NEAR(answer.middle.across_mm_px, 550 / 1640.0 / 0.6427876, 1e-6);  // 0.5217
  EXPECT_NEAR(answer.middle.sigma_mm, 0.02609, 1e-5);
}

double height_seen(const Rig& rig, double row, Profile* profile = nullptr, double sigma_px = 0.05) {
  Stripe stripe;
  for (int k = -5; k <= 5; ++k) {
    StripePoint p;
    p.x = rig.sensors[0].camera.cx + k, p.y = row;
    p.normal_y = 1;
    p.sigma_px = sigma_px;
    stripe.points.push_back(p);
  }
  Profile out;
  triangulate_stripes({stripe}, rig, 0, {}, out);
  if (profile) *profile = out;
  return out.points.at(5).position.z();
}

// The same sensor through the reconstruction: heights at the image's edges, mm a pixel, predicted sigma.
TEST(SensorDesign, IsWhatTheReconstructionComputes) {
  const SensorDesign design{550, 40, 1640, 960, 700, 0.05};
  const DesignAnswer answer = design_sensor(design);
  const Rig rig = rig_of_design(design);
  const double middle = height_seen(rig, 349.5), cy = 349.5;
  EXPECT_NEAR(height_seen(rig, cy + 350) - middle, answer.near.height_mm, 1e-3);
  EXPECT_NEAR(height_seen(rig, cy - 350) - middle, answer.far.height_mm, 1e-3);
  EXPECT_NEAR((height_seen(rig, cy + 0.5) - height_seen(rig, cy - 0.5)), answer.middle.across_mm_px, 1e-4);
  Profile profile;
  height_seen(rig, cy, &profile);
  EXPECT_NEAR(profile.points.at(5).sigma_mm, answer.middle.sigma_mm, 2e-4);
}

TEST(SensorDesign, AFlatAngleHasNoFarEnd) {
  const DesignAnswer answer = design_sensor({550, 10, 1000, 960, 700, 0.05});
  EXPECT_TRUE(std::isinf(answer.range_mm));
}

TEST(SensorDesign, WhatMakesNoSensorIsRefused) {
  EXPECT_THROW(design_sensor({0, 40, 1640, 960, 700, 0.05}), Error);
  EXPECT_THROW(design_sensor({550, 90, 1640, 960, 700, 0.05}), Error);
  EXPECT_THROW(design_sensor({550, 40, -1, 960, 700, 0.05}), Error);
  EXPECT_THROW(design_sensor({550, 40, 1640, 960, 700, -0.05}), Error);
}

}  // namespace
}  // namespace lightstripe
