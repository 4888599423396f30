// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/surface_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "block.h"

namespace lightstripe {
namespace {

const SurfaceProbe kTop{{0, 0}, {0, 1}};

TEST(SurfaceFit, EvenWearOfTheTop) {
  OnBlock block;
  for (double u = -3; u <= 3; u += 0.25) block.add(u, -0.4);
  const SurfaceFit fit = fit_surface(block.placed(), kTop);
  ASSERT_TRUE(fit.known()) << fit.reason;
  EXPECT_NEAR(fit.wear_mm, 0.4, 1e-9);
  EXPECT_NEAR(fit.along_mm, -0.4, 1e-9);
  EXPECT_NEAR(fit.slope, 0, 1e-9);
  EXPECT_NEAR(fit.place.y(), -0.4, 1e-9);
  EXPECT_EQ(fit.num_points, 13);  // within 1.5 mm
}

TEST(SurfaceFit, ASlopedSurfaceMovesAlsoWithTheSidewaysShift) {
  OnBlock block;
  for (double u = -3; u <= 3; u += 0.25) block.add(u, -0.4 + 0.1 * u);
  const SurfaceFit fit = fit_surface(block.placed(), kTop);
  EXPECT_NEAR(fit.slope, -0.1, 1e-6);  // to the left of up, u falls
  EXPECT_NEAR(fit.response.y(), 1, 1e-9);
  EXPECT_NEAR(fit.response.x(), -0.1, 1e-6);  // moved to +u, the surface over the origin sinks
}

TEST(SurfaceFit, WhatIsMissingIsSaid) {
  OnBlock none, few, one_side, hole;
  for (double u = -1; u <= 0.2; u += 0.3) few.add(u, 0);
  for (double u = 0.1; u <= 1.5; u += 0.1) one_side.add(u, 0);
  for (double u = -1.5; u <= 1.5; u += 0.1)
    if (std::abs(u) > 0.8) hole.add(u, 0);
  EXPECT_EQ(fit_surface(none.placed(), kTop).reason, "not seen");
  EXPECT_EQ(fit_surface(few.placed(), kTop).reason, "too few points");
  EXPECT_EQ(fit_surface(one_side.placed(), kTop).reason, "seen on one side only");
  EXPECT_EQ(fit_surface(hole.placed(), kTop).reason, "hole in the section");
}

TEST(SurfaceFit, SigmaOfAWidthLeavesOutTheCommonShift) {
  Registration registration;
  registration.covariance(1, 1) = 0.04 * 0.04;  // shift along u
  SurfaceFit right, left;
  right.local_sigma_mm = 0.03, left.local_sigma_mm = 0.04;
  right.response = {1, 0}, left.response = {-1, 0};
  EXPECT_NEAR(sigma_of(right, registration), 0.05, 1e-12);
  EXPECT_NEAR(sigma_of_sum(right, left, registration), 0.05, 1e-12);  // of the two faces alone
}

TEST(SurfaceFit, ATurnActsByTheArm) {
  Registration registration;
  registration.covariance(0, 0) = 1e-6;  // 1 mrad
  SurfaceFit top;
  top.place = {30, -5}, top.response = {0, 1};
  EXPECT_NEAR(sigma_of(top, registration), 0.03, 1e-12);
}

}  // namespace
}  // namespace lightstripe
