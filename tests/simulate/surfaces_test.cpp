// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/surfaces.h"

#include <gtest/gtest.h>

#include "simulate/scene_world.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

/// 3 x 2 inner corners, 10 mm, 5 mm rim, 100 mm in front of the origin along z: corner (0, 0) at (0, 0, 100).
World board_world() {
  Target target;
  target.columns = 3;
  target.rows = 2;
  target.pitch_x = target.pitch_y = 10;
  World world;
  world.boards.push_back({{Eigen::Quaterniond::Identity(), Vector3d(0, 0, 100)}, target, 5, 0.9, 0.1});
  return world;
}

double albedo_at(double x, double y) {
  const auto hit = first_hit(board_world(), {Vector3d::Zero(), Vector3d(x, y, 100)});
  return hit ? hit->material.albedo : -1;
}

TEST(Surfaces, BoardsSquaresAlternateBeginningWithWhiteBeyondTheFirstCorner) {
  EXPECT_EQ(albedo_at(-5, -5), 0.9);
  EXPECT_EQ(albedo_at(5, -5), 0.1);
  EXPECT_EQ(albedo_at(5, 5), 0.9);
  EXPECT_EQ(albedo_at(-5, 5), 0.1);
  EXPECT_EQ(albedo_at(25, 15), 0.1);  // the last square: 3 columns and 2 rows on, an odd number
}

TEST(Surfaces, BoardEndsWithItsWhiteRim) {
  EXPECT_EQ(albedo_at(-12, 5), 0.9);
  EXPECT_EQ(albedo_at(-14.9, -14.9), 0.9);
  EXPECT_EQ(albedo_at(34.9, 24.9), 0.9);
  EXPECT_EQ(albedo_at(35.1, 5), -1);
  EXPECT_EQ(albedo_at(5, -15.1), -1);
}

TEST(Surfaces, BoardIsDarkFromBehind) {
  const auto hit = first_hit(board_world(), {Vector3d(0, 0, 200), Vector3d(5, -5, -100)});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->material.albedo, 0.1);
  EXPECT_EQ(hit->normal, Vector3d(0, 0, 1));
}

TEST(Surfaces, SphereIsHitOnItsNearSide) {
  World world;
  world.spheres.push_back({Vector3d(0, 0, 50), 20, {}});
  const auto hit = first_hit(world, {Vector3d(12, 0, 0), Vector3d(0, 0, 2)});  // 12-16-20 triangle
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->s, 17, 1e-13);
  EXPECT_NEAR((hit->normal - Vector3d(0.6, 0, -0.8)).norm(), 0, 1e-14);
  EXPECT_FALSE(first_hit(world, {Vector3d(20.001, 0, 0), Vector3d(0, 0, 1)}));
}

TEST(Surfaces, CylinderHasMantleAndFlatEnds) {
  Scene scene;
  scene.rail.profile = "none";
  CylinderObject cylinder;
  cylinder.center = {0, 0, 0};
  cylinder.axis = {0, 0, 1};
  cylinder.radius_mm = 5;
  cylinder.length_mm = 40;
  scene.cylinders.push_back(cylinder);
  const World world = scan_world(scene, {}, 0);
  const auto mantle = first_hit(world, {Vector3d(10, 3, 19), Vector3d(-1, 0, 0)});
  ASSERT_TRUE(mantle);
  EXPECT_NEAR(mantle->s, 6, 1e-12);
  EXPECT_NEAR((mantle->normal - Vector3d(0.8, 0.6, 0)).norm(), 0, 1e-12);
  EXPECT_FALSE(first_hit(world, {Vector3d(10, 3, 21), Vector3d(-1, 0, 0)}));
  const auto end = first_hit(world, {Vector3d(1, 2, 50), Vector3d(0, 0, -1)});
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->s, 30, 1e-12);
  EXPECT_NEAR((end->normal - Vector3d(0, 0, 1)).norm(), 0, 1e-12);
  EXPECT_FALSE(first_hit(world, {Vector3d(4, 4, 50), Vector3d(0, 0, -1)}));
}

TEST(Surfaces, StaircaseHasItsHeightsAndItsYaw) {
  Scene scene;
  scene.rail.profile = "none";
  StepsObject steps;
  steps.base = {100, 0, -10};
  steps.heights_mm = {5, 15};
  steps.run_mm = 20;
  steps.length_mm = 50;
  scene.steps.push_back(steps);
  const auto height_at = [&](double x, double y) {
    const auto hit = first_hit(scan_world(scene, {}, 0), {Vector3d(x, y, 100), Vector3d(0, 0, -1)});
    return hit ? 100 - hit->s : -999;
  };
  EXPECT_NEAR(height_at(100, -10), -5, 1e-12);
  EXPECT_NEAR(height_at(124, 10), 5, 1e-12);
  EXPECT_EQ(height_at(126, 10), -999);
  scene.steps[0].yaw_deg = 90;  // the treads' order turns from +y to -x
  EXPECT_NEAR(height_at(110, 24), -5, 1e-12);
  EXPECT_NEAR(height_at(90, -24), 5, 1e-12);
}

TEST(Surfaces, NothingBlocksTheSurfaceThatIsLookedAtButWhatStandsBefore) {
  World world;
  world.ground = GroundObject{0, {}};
  world.spheres.push_back({Vector3d(0, 0, 50), 10, {}});
  EXPECT_FALSE(blocked(world, {100, 0, 100}, {0, 0, 0}));
  EXPECT_TRUE(blocked(world, {0, 0, 100}, {0, 0, 0}));
  EXPECT_FALSE(blocked(world, {0, 0, 100}, {0, 0, 60}));  // the sphere's own top
}

}  // namespace
}  // namespace lightstripe
