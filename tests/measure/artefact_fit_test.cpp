// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Exact bodies, then noisy ones.
#include "measure/artefact_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

TEST(ArtefactFit, ABallFromItsUpperHalf) {
  Random random(2);
  const Vector3d center(3, -4, 80);
  for (const double noise : {0.0, 0.05}) {
    Points3 points;
    for (int i = 0; i < 2000; ++i) {
      const double a = random.uniform(0, 6.283), h = random.uniform(0.3, 1);
      const double r = 20 + noise * random.gaussian();
      points.push_back(
          center + r * Vector3d(std::sqrt(1 - h * h) * std::cos(a), std::sqrt(1 - h * h) * std::sin(a), h));
    }
    RoundBody start;
    start.center = center + Vector3d(2, 1, -3), start.radius = 17;
    const RoundBody found = fit_round_body(points, start, false);
    EXPECT_LT((found.center - center).norm(), noise > 0 ? 0.02 : 1e-8);
    EXPECT_NEAR(found.radius, 20, noise > 0 ? 0.015 : 1e-8);
  }
}

TEST(ArtefactFit, ACylinderWithItsAxis) {
  const Vector3d axis = Vector3d(1, 0.1, -0.05).normalized(), first = axis.unitOrthogonal(),
                 second = axis.cross(first);
  Points3 points;
  for (int i = 0; i < 60; ++i)
    for (int k = 0; k < 40; ++k) {
      const double a = 0.06 * k;
      points.push_back(Vector3d(0, 5, 70) + (i - 30.0) * axis +
                       12 * (std::cos(a) * first + std::sin(a) * second));
    }
  RoundBody start;
  start.center = Vector3d(0, 6, 69), start.axis = Vector3d::UnitX(), start.radius = 11;
  const RoundBody found = fit_round_body(points, start, true);
  EXPECT_NEAR(found.radius, 12, 1e-7);
  EXPECT_LT(found.axis.cross(axis).norm(), 1e-7);
}

TEST(ArtefactFit, ParallelFacesShareTheirNormal) {
  Random random(3);
  const Vector3d normal = Vector3d(0.1, -0.2, 1).normalized();
  Points3 low, high;
  for (int i = 0; i < 300; ++i) {
    const Vector3d p(random.uniform(-20, 20), random.uniform(-20, 20), 0);
    low.push_back(p - normal * normal.dot(p) + 5 * normal);
    high.push_back(p - normal * normal.dot(p) + 17 * normal);
  }
  const ParallelFaces found = fit_parallel_faces(low, high, true);
  EXPECT_LT(found.normal.cross(normal).norm(), 1e-9);
  EXPECT_NEAR(std::abs(found.offset[1] - found.offset[0]), 12, 1e-9);
}

}  // namespace
}  // namespace lightstripe
