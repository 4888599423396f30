// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/laser_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using testing::Each;
using testing::ElementsAre;
using testing::Eq;

const auto kNone = Each(Eq(std::nullopt));

const Camera kCamera{640, 480, 1000, 1000, 320, 240, {}};

Sensor sensor_with(const std::vector<Plane>& planes) { return {"gauge", kCamera, planes, {}}; }

// An upright stripe at this column (a level one at this row).
Stripe upright(double x) { return {{{.x = x, .y = 100, .normal_x = 1}, {.x = x, .y = 300, .normal_x = 1}}}; }
Stripe level(double y) { return {{{.x = 100, .y = y, .normal_y = 1}, {.x = 300, .y = y, .normal_y = 1}}}; }

TEST(AssignLaserPlanes, OnePlaneOwnsAllStripes) {
  const auto sensor = sensor_with({{Vector3d::UnitX(), 100}});
  EXPECT_THAT(assign_laser_planes({upright(500), upright(520), upright(400)}, sensor), ElementsAre(0, 0, 0));
  EXPECT_THAT(assign_laser_planes({}, sensor), ElementsAre());
}

TEST(AssignLaserPlanes, ParallelSheetsAreOrderedLeftToRight) {
  // Sheets x = 140, 100, 120 mm on a wall at z = 500 mm: columns 600, 520, 560.
  const auto sensor =
      sensor_with({{Vector3d::UnitX(), 140}, {Vector3d::UnitX(), 100}, {Vector3d::UnitX(), 120}});
  EXPECT_THAT(assign_laser_planes({upright(520), upright(560), upright(600)}, sensor), ElementsAre(1, 2, 0));
  EXPECT_THAT(assign_laser_planes({upright(600), upright(520), upright(560)}, sensor), ElementsAre(0, 1, 2));
}

TEST(AssignLaserPlanes, SheetsOnBothSidesOfTheCameraAreOrdered) {
  // x = 50 and x = -50 (as n.X = d with d > 0) at z = 500: columns 420 and 220.
  const auto sensor = sensor_with({{Vector3d::UnitX(), 50}, {-Vector3d::UnitX(), 50}});
  EXPECT_THAT(assign_laser_planes({upright(220), upright(420)}, sensor), ElementsAre(1, 0));
}

TEST(AssignLaserPlanes, LevelLinesAreOrderedTopToBottom) {
  const auto sensor = sensor_with({{Vector3d::UnitY(), 40}, {Vector3d::UnitY(), 20}});
  EXPECT_THAT(assign_laser_planes({level(320), level(280)}, sensor), ElementsAre(0, 1));
}

TEST(AssignLaserPlanes, FanFromOneSourceOnASteppedSurfaceIsOrdered) {
  // Laser at (200, 0, 0), two sheets aimed at x = 0 for z = 400 and z = 500; stripes where they meet z = 450,
  // 470.
  const auto sheet = [](double z) { return canonical({{z, 0, 200}, 200 * z}); };
  const auto sensor = sensor_with({sheet(400), sheet(500)});
  const auto column = [](double aim, double z) { return 320 + 1000 * (200 - 200 * z / aim) / z; };
  EXPECT_THAT(assign_laser_planes({upright(column(400, 450)), upright(column(500, 470))}, sensor),
              ElementsAre(0, 1));
  EXPECT_THAT(assign_laser_planes({upright(column(500, 450)), upright(column(400, 470))}, sensor),
              ElementsAre(1, 0));
}

TEST(AssignLaserPlanes, SheetsThatCrossInDepthAreOrderedAtTheStripesDepth) {
  // From (200, 0, 0) and (150, 0, 0), both aimed at x = 0, z = 450: before it the one is on the right, behind
  // it left.
  const auto sheet = [](double source) { return canonical({{450, 0, source}, 450 * source}); };
  const auto sensor = sensor_with({sheet(200), sheet(150)});
  const auto column = [](double source, double z) { return 320 + 1000 * source * (1 - z / 450) / z; };
  for (double z : {380.0, 520.0}) {
    EXPECT_THAT(assign_laser_planes({upright(column(200, z)), upright(column(150, z))}, sensor),
                ElementsAre(0, 1));
    EXPECT_THAT(assign_laser_planes({upright(column(150, z)), upright(column(200, z))}, sensor),
                ElementsAre(1, 0));
  }
}

TEST(AssignLaserPlanes, OfSeveralDepthsTheOneThatExplainsAllStripesDecides) {
  // x = 120 and x = 100, and a slanted sheet from (500, 0, 0) that passes between them at z = 500 only: x =
  // 110. Columns there 560, 520, 540; nearer or farther the slanted one lies outside the two.
  const Plane slanted = canonical({{500, 0, 390}, 500 * 500});
  const auto sensor = sensor_with({slanted, {Vector3d::UnitX(), 120}, {Vector3d::UnitX(), 100}});
  EXPECT_THAT(assign_laser_planes({upright(520), upright(540), upright(560)}, sensor), ElementsAre(2, 0, 1));
}

TEST(AssignLaserPlanes, AnotherNumberOfStripesIsNotGuessed) {
  const auto sensor = sensor_with({{Vector3d::UnitX(), 100}, {Vector3d::UnitX(), 140}});
  EXPECT_THAT(assign_laser_planes({upright(520)}, sensor), kNone);
  EXPECT_THAT(assign_laser_planes({upright(520), upright(530), upright(600)}, sensor), kNone);
  EXPECT_THAT(assign_laser_planes({upright(520), Stripe{}}, sensor), kNone);
}

TEST(AssignLaserPlanes, CrossedPlanesHaveNoOrder) {
  const auto sensor = sensor_with({{Vector3d::UnitX(), 100}, {Vector3d::UnitY(), 100}});
  EXPECT_THAT(assign_laser_planes({upright(520), level(440)}, sensor), kNone);
}

TEST(AssignLaserPlanes, SensorWithoutPlanesAssignsNothing) {
  EXPECT_THAT(assign_laser_planes({upright(520)}, sensor_with({})), kNone);
}

// ---- with a known measuring range ----

/// Three sheets through (0, 0, 450), (30, 0, 450), (60, 0, 450), from a laser at (300, 0, 0); 400 to 500 mm.
Sensor ranged_sensor() {
  std::vector<Plane> planes;
  for (const double x : {0.0, 30.0, 60.0}) planes.push_back(canonical({{450, 0, 300 - x}, 450 * 300}));
  Sensor sensor = sensor_with(planes);
  sensor.depth_range_mm = {400, 500};
  return sensor;
}

/// The column where sheet k meets a wall at depth z.
double column(int k, double z) { return 320 + 1000 * (300 - (300 - 30.0 * k) * z / 450) / z; }

Stripe piece(double x, double top, double bottom) {
  return {{{.x = x, .y = top, .normal_x = 1}, {.x = x, .y = bottom, .normal_x = 1}}};
}

TEST(AssignLaserPlanesByReach, AllLinesGoByOrder) {
  const auto sensor = ranged_sensor();
  EXPECT_THAT(assign_laser_planes({upright(column(1, 440)), upright(column(0, 440)), upright(column(2, 440))},
                                  sensor),
              ElementsAre(1, 0, 2));
}

TEST(AssignLaserPlanesByReach, ALineThatOnlyOnePlaneReachesNeedsNoOthers) {
  // 40 mm nearer than the sheets' crossing of the axis moves a line by 0.67 mm a mm: at z = 400 sheet 2 is
  // farther right than any other sheet within the range.
  const auto sensor = ranged_sensor();
  EXPECT_THAT(assign_laser_planes({upright(column(2, 401))}, sensor), ElementsAre(2));
  EXPECT_THAT(assign_laser_planes({upright(column(0, 499))}, sensor), ElementsAre(0));
}

TEST(AssignLaserPlanesByReach, ALineThatTwoPlanesReachIsDropped) {
  // Sheet 1 at z = 450 is where sheet 0 is at z = 430.6 and sheet 2 at z = 471: all within the range.
  EXPECT_THAT(assign_laser_planes({upright(column(1, 450))}, ranged_sensor()), kNone);
}

TEST(AssignLaserPlanesByReach, PiecesOfABrokenLineShareTheirPlane) {
  const auto sensor = ranged_sensor();
  EXPECT_THAT(assign_laser_planes({piece(column(0, 450), 100, 200), piece(column(0, 450), 220, 300),
                                   piece(column(1, 450), 100, 300), piece(column(2, 450), 100, 300)},
                                  sensor),
              ElementsAre(0, 0, 1, 2));
}

TEST(AssignLaserPlanesByReach, LightThatNoPlaneReachesDoesNotDisturbTheOthers) {
  const auto sensor = ranged_sensor();
  EXPECT_THAT(
      assign_laser_planes(
          {upright(column(0, 440)), upright(600), upright(column(1, 440)), upright(column(2, 440))}, sensor),
      ElementsAre(0, std::nullopt, 1, 2));
}

TEST(AssignLaserPlanesByReach, OneLineTooManyLeavesThoseItTouchesOpen) {
  // A reflection between the lines of sheets 0 and 1 may be either's: nothing is certain any more.
  const auto sensor = ranged_sensor();
  const auto planes = assign_laser_planes(
      {upright(column(0, 450)), upright(column(0, 445)), upright(column(1, 450)), upright(column(2, 450))},
      sensor);
  EXPECT_THAT(planes, kNone);
}

// ---- beyond the measuring range ----

TEST(AssignLaserPlanesByReach, ALineThatMayLieNearTheRangeIsDroppedUnderThatName) {
  // Sheet 1 at 470 is where sheet 2 would be at 525, a quarter of the range beyond it.
  auto sensor = ranged_sensor();
  sensor.laser_planes.erase(sensor.laser_planes.begin());  // sheets 1 and 2
  const auto decisions = decide_laser_planes({upright(column(1, 470))}, sensor);
  EXPECT_EQ(decisions[0].plane, std::nullopt);
  EXPECT_TRUE(decisions[0].may_lie_outside);
  EXPECT_EQ(decisions[0].outside_mm, std::nullopt);
}

TEST(AssignLaserPlanesByReach, TheHeadIsKeptWhereTheFootLiesOutside) {
  // The foot, 60 mm behind the range, on both sides of the head: its lines look like those of the next sheets
  // within it. On the right the first is hidden.
  const auto sensor = ranged_sensor();
  std::vector<Stripe> stripes;
  for (int k = 0; k < 3; ++k) stripes.push_back(piece(column(k, 440), 150, 250));
  for (int k = 0; k < 3; ++k) stripes.push_back(piece(column(k, 560), 40, 152));
  for (int k = 1; k < 3; ++k) stripes.push_back(piece(column(k, 560), 248, 360));
  const auto decisions = decide_laser_planes(stripes, sensor);
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(decisions[i].plane, k);
    EXPECT_EQ(decisions[3 + i].plane, std::nullopt);
    EXPECT_TRUE(decisions[3 + i].may_lie_outside);
    ASSERT_TRUE(decisions[3 + i].outside_mm);
    EXPECT_NEAR(decisions[3 + i].outside_mm->front(), 560, 0.01);
    EXPECT_NEAR(decisions[3 + i].outside_mm->back(), 560, 0.01);
  }
  for (std::size_t i = 6; i < 8; ++i) {
    EXPECT_EQ(decisions[i].plane, std::nullopt);
    EXPECT_TRUE(decisions[i].may_lie_outside);
  }
}

TEST(AssignLaserPlanesByReach, AStrayLightAloneProvesNothing) {
  const auto sensor = ranged_sensor();
  EXPECT_THAT(assign_laser_planes({piece(column(2, 401), 100, 200), piece(600, 220, 300)}, sensor),
              ElementsAre(2, std::nullopt));
}

TEST(AssignLaserPlanesByReach, AGroupThatCannotBeDoesNotTakeTheOthersAlong) {
  // Seven lines beside each other: more stray light than anybody would sort out.
  const auto sensor = ranged_sensor();
  std::vector<Stripe> stripes;
  for (int k = 0; k < 3; ++k) stripes.push_back(piece(column(k, 450), 100, 200));
  for (int k = 0; k < 7; ++k) stripes.push_back(piece(300 + 25 * k, 220, 300));
  const auto planes = assign_laser_planes(stripes, sensor);
  EXPECT_THAT(std::vector(planes.begin(), planes.begin() + 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(std::vector(planes.begin() + 3, planes.end()), kNone);
}

/// Where a sheet n.X = d meets a wall at depth z, from column 200 to 440.
Stripe line_on_wall(const Plane& sheet, double z) {
  Stripe stripe;
  const Eigen::Vector2d across = sheet.normal.head<2>().normalized();
  for (double x = 200; x <= 440; x += 4) {
    const double x_mm = (x - 320) / 1000 * z;
    const double y_mm = (sheet.offset - sheet.normal.z() * z - sheet.normal.x() * x_mm) / sheet.normal.y();
    stripe.points.push_back(
        {.x = x, .y = 240 + 1000 * y_mm / z, .normal_x = across.x(), .normal_y = across.y()});
  }
  return stripe;
}

TEST(AssignLaserPlanesByReach, LinesThatCrossGoByTheirOrderAtBothEnds) {
  // Sheets turned by 30 degrees to both sides of the line of sight, from below; they meet in the middle.
  std::vector<Plane> planes;
  for (const double turn : {-0.52, 0.52}) {
    const Vector3d n = Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * Vector3d(0, 0.766, 0.643);
    planes.push_back({n, 450 * n.z()});
  }
  auto sensor = sensor_with(planes);
  sensor.depth_range_mm = {380, 520};
  for (const double z : {430.0, 450.0, 470.0}) {
    const Stripe a = line_on_wall(planes[0], z), b = line_on_wall(planes[1], z);
    EXPECT_THAT(assign_laser_planes({a, b}, sensor), ElementsAre(0, 1)) << z;
    EXPECT_THAT(assign_laser_planes({b, a}, sensor), ElementsAre(1, 0)) << z;
  }
}

}  // namespace
}  // namespace lightstripe
