// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

TEST(Plane, CanonicalHasUnitNormalAndOffsetNotNegative) {
  const Plane plane = canonical({{0, -3, -4}, -10});
  EXPECT_LT((plane.normal - Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(plane.offset, 2);
  EXPECT_THROW(canonical({Vector3d::Zero(), 1}), std::logic_error);
}

TEST(Plane, RayMeetsPlaneWhereHandComputed) {
  // x + z = 500 (times sqrt 1/2); the ray (0.25, 0.1, 1) s: 1.25 s = 500, s = 400.
  const double h = std::sqrt(0.5);
  const auto met = intersect({{h, 0, h}, 500 * h}, Vector3d::Zero(), {0.25, 0.1, 1});
  ASSERT_TRUE(met);
  EXPECT_LT((*met - Vector3d(100, 40, 400)).norm(), 1e-10);
}

TEST(Plane, ParallelRayAndPlaneBehindMeetNowhere) {
  const Plane wall{Vector3d::UnitX(), 100};
  EXPECT_FALSE(intersect(wall, Vector3d::Zero(), {0, 0.2, 1}));
  EXPECT_FALSE(intersect(wall, Vector3d::Zero(), {-0.1, 0, 1}));
  EXPECT_FALSE(intersect(wall, {100, 0, 0}, {0.1, 0, 1}));  // starts on it
  EXPECT_TRUE(intersect(wall, Vector3d::Zero(), {1e-6, 0, 1}));
}

TEST(Plane, TransformedPlaneHoldsTheTransformedPoints) {
  const Rigid3 a_from_b{Eigen::Quaterniond(0.8, 0.2, -0.4, 0.4).normalized(), {120, -40, 700}};
  const Plane plane_b = canonical({{1, 2, -0.5}, 300});
  const Plane plane_a = transformed(plane_b, a_from_b.rotation.toRotationMatrix(), a_from_b.translation);
  EXPECT_NEAR(plane_a.normal.norm(), 1, 1e-15);
  EXPECT_GE(plane_a.offset, 0);
  const Vector3d foot = plane_b.offset * plane_b.normal;
  for (const Vector3d& side : {Vector3d(0, 0, 0), Vector3d(2, -1, 0), Vector3d(0, 0.5, 2)}) {
    const Vector3d in_plane = foot + 100 * (side - plane_b.normal * plane_b.normal.dot(side));
    EXPECT_NEAR(plane_a.signed_distance(a_from_b * in_plane), 0, 1e-11);
  }
}

TEST(FitPlane, RecoversAPlaneFromNoisyPoints) {
  Random random(1);
  const Plane truth = canonical({{0.2, -0.3, 0.9}, 450});
  const Vector3d e1 = truth.normal.unitOrthogonal(), e2 = truth.normal.cross(e1);
  std::vector<Vector3d> points;
  for (int i = 0; i < 4000; ++i)
    points.push_back(truth.normal * (truth.offset + 0.05 * random.gaussian()) + e1 * random.uniform(-60, 60) +
                     e2 * random.uniform(-40, 40));
  const PlaneFit fit = fit_plane(points);
  // Tilt known to 0.05 / (40 / sqrt 3) / sqrt(4000) = 3.4e-5 rad, offset at the centroid to 0.05 / sqrt(4000)
  // = 8e-4 mm but the origin lies up to 450 mm away along the normal, where a tilt counts in second order
  // only. 5 sigma.
  EXPECT_LT((fit.plane.normal - truth.normal).norm(), 5 * 3.4e-5);
  EXPECT_NEAR(fit.plane.offset, truth.offset, 5 * 8e-4);
  EXPECT_NEAR(fit.rms, 0.05, 5 * 0.05 / std::sqrt(8000));
  EXPECT_TRUE(fit.determined());
}

TEST(FitPlane, PointsOnOneLineDetermineNoPlane) {
  std::vector<Vector3d> line, place(5, Vector3d(1, 2, 3));
  for (int i = 0; i < 20; ++i) line.emplace_back(3 * i, 2 * i, 400 - i);
  EXPECT_FALSE(fit_plane(line).determined());
  EXPECT_FALSE(fit_plane(place).determined());
  EXPECT_THROW(fit_plane(std::span(line).first(2)), std::logic_error);
}

}  // namespace
}  // namespace lightstripe
