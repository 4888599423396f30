// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/artefact_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

TEST(SupportOf, FallsWithTheSquareOfTheDistance) {
  const RoundBody ball{{0, 0, 0}, Vector3d::Zero(), 10};
  EXPECT_EQ(support_of({{10, 0, 0}}, ball, 2), 1);
  EXPECT_NEAR(support_of({{11, 0, 0}, {0, 9, 0}}, ball, 2), 0.75 + 0.75, 1e-12);
  EXPECT_EQ(support_of({{13, 0, 0}}, ball, 2), 0);
}

TEST(FindRoundBody, ABallAmongOtherPoints) {
  Random random(6);
  Points3 points;
  for (int i = 0; i < 400; ++i) {
    const double z = random.uniform(0.2, 1), a = random.uniform(0, 2 * std::numbers::pi),
                 r = std::sqrt(1 - z * z);
    points.push_back(Vector3d(5, -3, 40) + 15 * Vector3d(r * std::cos(a), r * std::sin(a), z));
  }
  for (int i = 0; i < 150; ++i)
    points.emplace_back(random.uniform(-60, 60), random.uniform(-60, 60), random.uniform(0, 60));
  ArtefactSpec spec;
  spec.size_mm = 30;
  const RoundBody ball = find_round_body(points, spec, axes_of_round_body(spec).front());
  EXPECT_NEAR(ball.radius, 15, 0.1);
  EXPECT_NEAR((ball.center - Vector3d(5, -3, 40)).norm(), 0, 0.2);
  spec.size_mm = 45;  // there is none of this size
  EXPECT_LT(support_of(points, find_round_body(points, spec, {Vector3d::Zero()}), 1), 150);
}

TEST(FindStep, TwoFacesAtTheKnownDistance) {
  Points3 points;
  for (double x = 0; x < 40; x += 2)
    for (double y = -30; y < 30; y += 1) points.emplace_back(x, y, y > 0 ? 10.2 : 0.2);
  ArtefactSpec spec;
  spec.kind = Artefact::kStep, spec.size_mm = 10;
  const auto faces = find_step(points, spec);
  ASSERT_TRUE(faces);
  EXPECT_NEAR(std::abs(faces->normal.z()), 1, 1e-6);
  EXPECT_NEAR(std::abs(faces->offset[1] - faces->offset[0]), 10, 0.5);
  spec.size_mm = 25;
  const auto none = find_step(points, spec);
  EXPECT_TRUE(!none || std::abs(none->normal.z()) < 0.999);
}

TEST(PointsToSearch, LeaveOutTheGround) {
  Random random(7);
  Points3 points;
  for (int i = 0; i < 600; ++i) points.emplace_back(random.uniform(-50, 50), random.uniform(-50, 50), 0);
  for (int i = 0; i < 300; ++i)
    points.emplace_back(random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(5, 20));
  ArtefactSpec spec;
  spec.size_mm = 20;
  const Points3 rest = points_to_search(points, spec);
  EXPECT_EQ(rest.size(), 300U);
  for (const Vector3d& p : rest) EXPECT_GT(p.z(), 1);
}

TEST(AxesOfRoundBody, ABallHasNoneASectionLooksAlongTheTravel) {
  ArtefactSpec spec;
  EXPECT_TRUE(axes_of_round_body(spec).front().front().isZero());
  spec.kind = Artefact::kCylinder;
  ASSERT_EQ(axes_of_round_body(spec).size(), 3U);
  EXPECT_EQ(axes_of_round_body(spec)[1].size(), 49U);
  EXPECT_EQ(axes_of_round_body(spec)[1][24], Vector3d::UnitY());
  spec.section = true;
  EXPECT_EQ(axes_of_round_body(spec).front().front(), Vector3d::UnitX());
}

}  // namespace
}  // namespace lightstripe
