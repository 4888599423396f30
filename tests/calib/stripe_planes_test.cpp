// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Stripes in space: planes through them, wrong ones among them.
#include "calib/start/stripe_planes.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

const Plane kLaser{Vector3d(0.1, 0.6, 0.79).normalized(), 400};

/// A straight stripe within the plane, with noise across it.
StripeInSpace stripe_in(const Plane& plane, std::size_t view, Random& random, double noise_mm) {
  const Vector3d u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
  const double angle = random.uniform(-0.6, 0.6);
  const Vector3d along = std::cos(angle) * u + std::sin(angle) * v;
  const Vector3d start = plane.offset * plane.normal + random.uniform(-40, 40) * v;
  StripeInSpace stripe;
  stripe.view = view;
  for (int i = 0; i < 40; ++i)
    stripe.points.push_back(start + (i - 20.0) * along + noise_mm * random.gaussian() * plane.normal);
  return stripe;
}

std::vector<StripeInSpace> stripes(int good, int wrong, double noise_mm) {
  Random random(5);
  std::vector<StripeInSpace> all;
  for (int i = 0; i < good; ++i) all.push_back(stripe_in(kLaser, all.size(), random, noise_mm));
  for (int i = 0; i < wrong; ++i) {
    const Vector3d tilt(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.3);
    const Plane other{(kLaser.normal + tilt).normalized(), 400 + random.uniform(-30, 30)};
    all.push_back(stripe_in(other, all.size(), random, noise_mm));
  }
  return all;
}

TEST(StripePlanes, ThePlaneThroughGoodStripesIsTheirs) {
  const auto all = stripes(8, 0, 0.05);
  std::vector<const StripeInSpace*> pointers;
  for (const auto& one : all) pointers.push_back(&one);
  const PlaneFit fit = plane_through(pointers);
  ASSERT_TRUE(fit.determined());
  EXPECT_LT(fit.plane.normal.cross(kLaser.normal).norm(), 1e-3);
  EXPECT_NEAR(fit.rms, 0.05, 0.01);  // 320 points: 4 %
  EXPECT_LT(distance_to(fit.plane, all[0]), 0.1);
}

TEST(StripePlanes, NearlyHalfOfTheStripesMayBeWrong) {
  const auto all = stripes(9, 6, 0.05);
  const auto plane = least_median_plane(all);
  ASSERT_TRUE(plane);
  EXPECT_LT(plane->normal.cross(kLaser.normal).norm(), 0.01);
  const auto kept = stripes_in_one_plane(all);
  EXPECT_EQ(kept.size(), 9u);
  for (const auto* stripe : kept) EXPECT_LT(stripe->view, 9u);
}

TEST(StripePlanes, ParallelLinesOnOnePlaceSpanNone) {
  Random random(1);
  const StripeInSpace one = stripe_in(kLaser, 0, random, 0);
  EXPECT_EQ(stripes_in_one_plane({one, one, one}).size(), 3u);
}

}  // namespace
}  // namespace lightstripe
