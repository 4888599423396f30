// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/revolution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDatum = 100;  // mm

/// A rectangle 20 wide and 10 high on a datum of 100: a ring of radii 95 to 105.
Revolution ring() {
  return make_revolution({}, polygon_outline({{-10, -5}, {10, -5}, {10, 5}, {-10, 5}}), kDatum, {});
}

TEST(Revolution, AxialAndRadialRaysMeetARingWhereItStands) {
  const auto radial = first_hit(ring(), {3, 0, 300}, {0, 0, -2});
  ASSERT_TRUE(radial);
  EXPECT_NEAR(radial->s, (300 - 105) / 2.0, 1e-9);
  EXPECT_NEAR((radial->normal - Vector3d::UnitZ()).norm(), 0, 1e-12);
  const auto axial = first_hit(ring(), {-50, 0, 100}, {1, 0, 0});
  ASSERT_TRUE(axial);
  EXPECT_NEAR(axial->s, 40, 1e-9);
  EXPECT_NEAR((axial->normal + Vector3d::UnitX()).norm(), 0, 1e-12);
  EXPECT_FALSE(first_hit(ring(), {-50, 0, 0}, {1, 0, 0}));            // through the hole
  EXPECT_FALSE(first_hit(ring(), {0, 0, 300}, {0, 0, 1}));            // away from it
  EXPECT_NEAR(first_hit(ring(), {0, 0, 0}, {0, 0, 1})->s, 95, 1e-9);  // from inside
}

/// The torus R = 100, r = 8 as an oracle: its implicit function at the hit, and its gradient as the normal.
TEST(Revolution, ACircleMakesATorus) {
  const Rigid3 pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized())), {5, -7, 11}};
  const Revolution torus = make_revolution(pose, circle_outline(8), kDatum, {}, 0.05);
  Random random(4);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d from(random.uniform(-200, 200), random.uniform(-200, 200), 250);
    const Vector3d to(random.uniform(-15, 15), random.uniform(-110, 110), random.uniform(-110, 110));
    const auto hit = first_hit(torus, pose * from, pose.rotation * (to - from));
    if (!hit) continue;
    ++hits;
    const Vector3d p = from + hit->s * (to - from);
    const Vector3d ring_point = Vector3d(0, p.y(), p.z()).normalized() * kDatum;
    EXPECT_NEAR((p - ring_point).norm(), 8, 5e-5);  // chords of 0.05 on a circle of 8: 4e-5
    const Vector3d normal = pose.rotation * (p - ring_point).normalized();
    EXPECT_LT((hit->normal - normal).norm(), 2e-3);
    EXPECT_LT(hit->normal.dot(pose.rotation * (to - from)), 0);
  }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace lightstripe
