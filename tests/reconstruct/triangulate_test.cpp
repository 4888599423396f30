// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/triangulate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

// One camera at the rig's origin, axes alike, and the laser sheet x = 100 mm. The pixel (520, 340) sees along
// (0.2, 0.1, 1), which meets the sheet at (100, 50, 500).
Rig hand_rig() {
  Rig rig;
  rig.sensors.push_back({"gauge", {640, 480, 1000, 1000, 320, 240, {}}, {{Vector3d::UnitX(), 100}}, {}});
  return rig;
}

std::vector<Stripe> hand_stripe() {
  return {{{{.x = 520, .y = 340, .normal_x = 1, .normal_y = 0, .sigma_px = 0.1, .intensity = 200}}}};
}

ProfilePoint hand_point(const Rig& rig, const FramePosition& position) {
  Profile profile;
  triangulate_stripes(hand_stripe(), rig, 0, position, profile);
  EXPECT_EQ(profile.points.size(), 1u);
  EXPECT_EQ(profile.num_missed, 0);
  return profile.points.at(0);
}

void expect_at(const Vector3d& found, const Vector3d& expected) {
  EXPECT_LT((found - expected).norm(), 1e-10) << found.transpose() << " instead of " << expected.transpose();
}

TEST(Triangulate, HandComputedPoint) {
  const auto point = hand_point(hand_rig(), {});
  expect_at(point.position, {100, 50, 500});
  EXPECT_NEAR(point.u, 50, 1e-10);
  EXPECT_NEAR(point.v, 500, 1e-10);
  EXPECT_EQ(point.intensity, 200);
  EXPECT_EQ(point.sensor, 0);
  EXPECT_EQ(point.line, 0);
}

TEST(Triangulate, HandComputedSigma) {
  // In the sheet z = 100 / x, so dz = -100 / 0.2^2 / 1000 = -2.5 mm a px to the right; up and down a px moves
  // along y only. The section thus runs along y, and 0.1 px across the stripe are 0.25 mm square to it.
  EXPECT_NEAR(hand_point(hand_rig(), {}).sigma_mm, 0.25, 1e-12);
  Rig rig = hand_rig();
  rig.quality.section_shape_sigma_mm = 0.6;
  EXPECT_NEAR(hand_point(rig, {}).sigma_mm, 0.65, 1e-12);  // 0.25^2 + 0.6^2 = 0.65^2
}

TEST(Triangulate, SensorsPlaceInTheRigIsApplied) {
  Rig rig = hand_rig();
  rig.sensors[0].rig_from_camera = {Quaterniond(AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ())),
                                    {1, 2, 3}};
  const auto point = hand_point(rig, {});
  expect_at(point.position, {-50 + 1, 100 + 2, 500 + 3});
  EXPECT_NEAR(point.u, 102, 1e-10);
  EXPECT_NEAR(point.v, 503, 1e-10);
}

TEST(Triangulate, LinearTravelHasTheContractsSigns) {
  Rig rig = hand_rig();
  rig.motion.type = MotionType::kLinear;
  expect_at(hand_point(rig, {30, {}}).position, {130, 50, 500});
  rig.motion.moves = Moves::kObject;
  expect_at(hand_point(rig, {30, {}}).position, {70, 50, 500});
  expect_at(hand_point(rig, {-30, {}}).position, {130, 50, 500});
}

TEST(Triangulate, WithoutACalibratedMotionTheRigTravelsAlongItsX) {
  expect_at(hand_point(hand_rig(), {30, {}}).position, {130, 50, 500});
}

Rig rotary_rig(Moves moves) {
  Rig rig = hand_rig();
  rig.motion = {MotionType::kRotary, moves, Vector3d::UnitX(), {0, -7, 500}, Vector3d::UnitY()};
  return rig;
}

TEST(Triangulate, RotarySectionIsPlaceAlongTheAxisAndRadius) {
  for (const double angle : {0.0, 90.0, -33.0}) {
    const auto point = hand_point(rotary_rig(Moves::kObject), {angle, {}});
    EXPECT_NEAR(point.u, 57, 1e-10);   // 50 - (-7)
    EXPECT_NEAR(point.v, 100, 1e-10);  // (100, ., 500) from the axis x = 0, z = 500
  }
}

TEST(Triangulate, RotaryTravelHasTheDocumentedSigns) {
  // A quarter turn about +y takes x to -z. The object turned by +90 degrees: what is now at +x from the axis
  // stood at +z at travel 0 (x = R z). The rig turned by +90 degrees: what it sees at its +x lies at its old
  // -z.
  expect_at(hand_point(rotary_rig(Moves::kObject), {90, {}}).position, {0, 50, 600});
  expect_at(hand_point(rotary_rig(Moves::kRig), {90, {}}).position, {0, 50, 400});
}

TEST(Triangulate, PosesPutThePointsIntoTheirWorld) {
  Rig rig = hand_rig();
  rig.motion.type = MotionType::kLinear;
  const Rigid3 world_from_rig{Quaterniond(AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX())), {1000, 0, 0}};
  const auto point = hand_point(rig, {30, world_from_rig});  // the pose tells all: travel is not added
  expect_at(point.position, {1100, -500, 50});
  EXPECT_NEAR(point.u, 50, 1e-10);  // the section stays in the rig frame
  EXPECT_NEAR(point.v, 500, 1e-10);
}

TEST(Triangulate, RaysThatMissAreCountedNotGuessed) {
  Profile profile;
  std::vector<Stripe> stripes = hand_stripe();
  stripes[0].points.push_back({.x = 320, .y = 100, .normal_x = 1});  // parallel to the sheet
  stripes[0].points.push_back({.x = 300, .y = 100, .normal_x = 1});  // meets it behind the camera
  stripes[0].points.push_back({.x = std::nan(""), .y = 100, .normal_x = 1});
  triangulate_stripes(stripes, hand_rig(), 0, {}, profile);
  EXPECT_EQ(profile.points.size(), 1u);
  EXPECT_EQ(profile.num_missed, 3);
}

TEST(Triangulate, PixelsBeyondTheFoldAreCounted) {
  Rig rig = hand_rig();
  rig.sensors[0].camera.distortion[0] = -8;  // r - 8 r^3 has its maximum 0.136 at r = 0.204
  Profile profile;
  triangulate_stripes(hand_stripe(), rig, 0, {}, profile);  // at 0.224
  EXPECT_EQ(profile.points.size(), 0u);
  EXPECT_EQ(profile.num_missed, 1);
}

TEST(Triangulate, LinesWithoutALaserPlaneAreCounted) {
  Rig rig = hand_rig();
  rig.sensors[0].laser_planes.push_back({Vector3d::UnitX(), 140});
  Profile profile;
  triangulate_stripes(hand_stripe(), rig, 0, {}, profile);  // one line, two planes
  EXPECT_EQ(profile.points.size(), 0u);
  EXPECT_EQ(profile.num_missed, 1);
}

TEST(Triangulate, EachLineMeetsItsOwnPlane) {
  Rig rig = hand_rig();
  rig.sensors[0].laser_planes.push_back({Vector3d::UnitX(), 140});
  std::vector<Stripe> stripes = hand_stripe();
  stripes.insert(stripes.begin(), Stripe{{{.x = 600, .y = 240, .normal_x = 1}}});
  Profile profile;
  triangulate_stripes(stripes, rig, 0, {}, profile);
  ASSERT_EQ(profile.points.size(), 2u);
  expect_at(profile.points[0].position, {140, 0, 500});
  expect_at(profile.points[1].position, {100, 50, 500});
  EXPECT_EQ(profile.points[1].line, 1);
}

TEST(Triangulate, UnknownSensorIsTheCallersFault) {
  Profile profile;
  EXPECT_THROW(triangulate_stripes({}, hand_rig(), 1, {}, profile), std::logic_error);
}

// A lens with every term and an oblique sheet, as a real sensor has.
Rig oblique_rig() {
  Rig rig;
  const Camera camera{
      960,
      700,
      1640,
      1632,
      471.3,
      352.8,
      {-0.1, 0.05, 4e-4, -2e-4, 0.01, 0.02, -0.01, 0.005, 2e-3, -1e-3, -3e-3, 5e-4, 0.04, -0.06}};
  const Rigid3 rig_from_camera{Quaterniond(0.6, -0.4, 0.5, 0.3).normalized(), {20, -310, 140}};
  rig.sensors.push_back({"gauge", camera, {canonical({{0.8, 0.1, 0.58}, 330})}, rig_from_camera});
  return rig;
}

TEST(Triangulate, ReturnsThePointsThatWereProjected) {
  const Rig rig = oblique_rig();
  const Sensor& sensor = rig.sensors[0];
  Random random(11);
  int seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto truth = intersect(sensor.laser_planes[0], Vector3d::Zero(),
                                 {random.uniform(-0.28, 0.28), random.uniform(-0.2, 0.2), 1});
    ASSERT_TRUE(truth);
    const Vector2d pixel = *project(sensor.camera, *truth);
    Profile profile;
    triangulate_stripes({{{{.x = pixel.x(), .y = pixel.y(), .normal_x = 1}}}}, rig, 0, {}, profile);
    ASSERT_EQ(profile.points.size(), 1u);
    // Undistortion to 1e-13 of a range below 1 m, times the slant of the sheet (< 5).
    EXPECT_LT((profile.points[0].position - sensor.rig_from_camera * *truth).norm(), 1e-9);
    ++seen;
  }
  EXPECT_EQ(seen, 1000);
}

Vector3d position_of(const Rig& rig, const Vector2d& pixel) {
  Profile profile;
  triangulate_stripes({{{{.x = pixel.x(), .y = pixel.y(), .normal_x = 1}}}}, rig, 0, {}, profile);
  return profile.points.at(0).position;
}

TEST(Triangulate, SigmaIsTheFiniteDifferenceSquareToTheSection) {
  const Rig rig = oblique_rig();
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    const Vector2d pixel(random.uniform(0, 960), random.uniform(0, 700));
    const double angle = random.uniform(-3.2, 3.2), h = 1e-3;
    const Vector2d normal(std::cos(angle), std::sin(angle)), tangent(-normal.y(), normal.x());
    const Vector3d across =
        (position_of(rig, pixel + h * normal) - position_of(rig, pixel - h * normal)) / (2 * h);
    const Vector3d section =
        (position_of(rig, pixel + h * tangent) - position_of(rig, pixel - h * tangent)).normalized();
    const double expected = 0.3 * (across - section * section.dot(across)).norm();
    Profile profile;
    triangulate_stripes({{{{.x = pixel.x(),
                            .y = pixel.y(),
                            .normal_x = normal.x(),
                            .normal_y = normal.y(),
                            .sigma_px = 0.3}}}},
                        rig, 0, {}, profile);
    // Central differences: relative error about (h / 1640)^2 and 1e-10 mm of rounding over 2e-3 px.
    EXPECT_NEAR(profile.points.at(0).sigma_mm, expected, 1e-6 * expected);
  }
}

}  // namespace
}  // namespace lightstripe
