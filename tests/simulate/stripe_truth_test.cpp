// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/stripe_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

World ground_at(double height) {
  World world;
  world.ground = GroundObject{height, {1, 0, 1}};
  return world;
}

TEST(StripeTruth, OnTheGroundIsTheLineWhereTheSheetMeetsIt) {
  SceneSensor tilted = looking_down();
  tilted.laser.source = {200, 0, 400};
  tilted.laser.aim = {0, 0, 0};
  tilted.laser.normal = {2, 0, -1};  // the plane x = z / 2
  const SimulatedSensor sensor = make_sensor(tilted);
  const auto points = trace_stripe(ground_at(20), lit_view(sensor, 0), noise_free());
  ASSERT_GT(points.size(), 380U);
  for (const StripeTruth& point : points) {
    EXPECT_NEAR(point.position.z(), 20, 1e-9);
    EXPECT_NEAR(point.position.x(), 10, 1e-9);
    EXPECT_NEAR(point.pixel.x(), 159.5 + 1500 * 10 / 480.0, 1e-9);
    EXPECT_NEAR(point.pixel.y(), 119.5 - 1500 * point.position.y() / 480.0, 1e-9);
  }
}

TEST(StripeTruth, StepsAboutHalfAPixelAndReachesTheImagesBorder) {
  const SimulatedSensor sensor = make_sensor(looking_down());
  const auto points = trace_stripe(ground_at(0), lit_view(sensor, 0), noise_free());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = (points[i].pixel - points[i - 1].pixel).norm();
    EXPECT_GE(step, 0.5);
    EXPECT_LT(step, 0.7);
  }
  EXPECT_NEAR(std::max(points.front().pixel.y(), points.back().pixel.y()), 239, 0.6);
  EXPECT_NEAR(std::min(points.front().pixel.y(), points.back().pixel.y()), 0, 0.6);
}

TEST(StripeTruth, LeavesOutTheShadowOfAStep) {
  Scene scene;
  scene.rail.profile = "none";
  StepsObject step;
  step.base = {0, 0, 0};
  step.heights_mm = {15};
  step.run_mm = 10;  // y from -5 to 5
  scene.steps.push_back(step);
  World world = scan_world(scene, {}, 0);
  world.ground = GroundObject{0, {1, 0, 1}};
  const SimulatedSensor sensor = make_sensor(looking_down());
  const auto points = trace_stripe(world, lit_view(sensor, 0), noise_free());
  // From (y, z) = (-300, 400) over the edge (5, 15) light reaches the ground at 5 + 15 * 305 / 385.
  const double shadow_end = 5 + 15 * 305 / 385.0;
  double nearest_after = 1e9;
  int on_top = 0;
  for (const StripeTruth& point : points) {
    const double y = point.position.y(), z = point.position.z();
    EXPECT_FALSE(z < 1e-6 && y > 5 && y < shadow_end - 1e-6) << y;
    if (z < 1e-6 && y > 5) nearest_after = std::min(nearest_after, y);
    on_top += z > 15 - 1e-6;
  }
  EXPECT_NEAR(nearest_after, shadow_end, 0.2);
  EXPECT_GT(on_top, 40);
}

TEST(StripeTruth, LeavesOutWhatSomethingHidesFromTheCamera) {
  SceneSensor aside = looking_down();
  aside.position = {200, 0, 500};
  const SimulatedSensor sensor = make_sensor(aside);
  World world = ground_at(0);
  world.spheres.push_back({Vector3d(100, 0, 250), 10, {}});  // half way to the origin, off the sheet
  const double eye = Vector3d(200, 0, 500).norm(), half_way = eye / 2;
  // Seen from the eye the ball covers sines up to 10 / half_way; a ground point at y lies at atan(y / eye).
  const double hidden = eye * std::tan(std::asin(10 / half_way));
  double nearest = 1e9;
  for (const StripeTruth& point : trace_stripe(world, lit_view(sensor, 0), noise_free()))
    nearest = std::min(nearest, std::abs(point.position.y()));
  EXPECT_NEAR(nearest, hidden, 0.2);
}

TEST(StripeTruth, OnTheRailPointsLieOnItsOutlineAndInTheSheet) {
  const Scene scene;
  const SimulatedSensor sensor = make_sensor(scene.sensors[0]);
  const Outline square = polygon_outline({{-30, 0}, {30, 0}, {30, -60}, {-30, -60}});
  const World world = scan_world(scene, {square, {}}, 0);
  View view = lit_view(sensor, 30);
  view.moved.translation = {12, 0, 0};
  const auto points = trace_stripe(world, view, scene.imaging);
  ASSERT_GT(points.size(), 200U);
  for (const StripeTruth& point : points) {
    EXPECT_LT(closest_point(square, {point.position.y(), point.position.z()}).distance, 1e-9);
    EXPECT_NEAR(sensor.sheet.signed_distance(point.position - view.moved.translation), 0, 1e-9);
    EXPECT_GT(point.level, 0);
  }
}

}  // namespace
}  // namespace lightstripe
