// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Steps, cylinders and balls of known size among other things, with noise.
#include "measure/artefact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr double kNoise_mm = 0.02;

/// A scan over x in steps of 1 mm: heights over y by a function of (x, y); sections are groups.
struct Scan {
  std::vector<Vector3d> points;
  std::vector<int> groups;
  Random random{7};

  template <class HeightAt>
  void take(int sections, const HeightAt& height) {
    for (int s = 0; s < sections; ++s)
      for (double y = -40; y <= 40; y += 0.5) {
        const double x = s - sections / 2.0;
        points.emplace_back(x, y, height(x, y) + kNoise_mm * random.gaussian());
        groups.push_back(s);
      }
  }
  /// One section, its points in pieces.
  template <class HeightAt>
  void take_section(const HeightAt& height) {
    int i = 0;
    for (double y = -40; y <= 40; y += 0.2, ++i) {
      points.emplace_back(0, y, height(0, y) + kNoise_mm * random.gaussian());
      groups.push_back(i / 20);
    }
  }
  void turn(const Eigen::AngleAxisd& by) {
    for (Vector3d& p : points) p = by * p;
  }
};

/// A ball of that radius that lies on the ground z = -30.
auto ball(double radius) {
  return [=](double x, double y) {
    const double rest = radius * radius - x * x - (y - 3) * (y - 3);
    return rest > 0.1 * radius * radius ? radius - 30 + std::sqrt(rest) : -30;
  };
}
/// A cylinder of that radius along x.
auto cylinder(double radius) {
  return [=](double, double y) {
    const double rest = radius * radius - (y - 3) * (y - 3);
    return rest > 0.1 * radius * radius ? radius - 30 + std::sqrt(rest) : -30;
  };
}
double block(double, double y) { return std::abs(y - 5) < 12 ? -18 : -30; }  // 12 mm high

void expect_size(const Scan& scan, const ArtefactSpec& spec, double most_mm) {
  std::string why_not;
  const auto got = measure_artefact(scan.points, scan.groups, spec, why_not);
  ASSERT_TRUE(got) << why_not;
  EXPECT_NEAR(got->size_mm, spec.size_mm, most_mm);
  EXPECT_NEAR(got->size_mm, spec.size_mm, 4 * got->sigma_mm);
  EXPECT_LT(got->sigma_mm, most_mm);
  EXPECT_NEAR(got->scatter_mm, kNoise_mm, 0.5 * kNoise_mm);
}

TEST(Artefact, ABallOnTheGround) {
  Scan scan;
  scan.take(50, ball(12.7));
  expect_size(scan, {Artefact::kSphere, 25.4}, 0.02);
}

TEST(Artefact, ACylinderAtASlant) {
  Scan scan;
  scan.take(60, cylinder(10));
  scan.turn(Eigen::AngleAxisd(0.15, Vector3d(0.2, 0.5, 1).normalized()));
  expect_size(scan, {Artefact::kCylinder, 20}, 0.02);
}

TEST(Artefact, AStepThatLeans) {
  Scan scan;
  scan.take(40, block);
  scan.turn(Eigen::AngleAxisd(0.1, Vector3d(1, 0.5, 0.2).normalized()));
  expect_size(scan, {Artefact::kStep, 12}, 0.01);
}

TEST(Artefact, OneSectionTellsStepAndCylinder) {
  Scan step, round;
  step.take_section(block);
  step.turn(Eigen::AngleAxisd(0.1, Vector3d::UnitX()));
  expect_size(step, {Artefact::kStep, 12, true}, 0.03);
  round.take_section(cylinder(10));
  expect_size(round, {Artefact::kCylinder, 20, true}, 0.1);
}

TEST(Artefact, SigmaIsThatOfRepeatedScans) {
  double squares = 0, predicted = 0;
  constexpr int kScans = 20;
  for (int i = 0; i < kScans; ++i) {
    Scan scan;
    scan.random = Random(100 + static_cast<std::uint64_t>(i));
    scan.take(50, ball(12.7));
    std::string why_not;
    const auto got = measure_artefact(scan.points, scan.groups, {Artefact::kSphere, 25.4}, why_not);
    ASSERT_TRUE(got) << why_not;
    squares += std::pow(got->size_mm - 25.4, 2) / kScans;
    predicted += got->sigma_mm * got->sigma_mm / kScans;
  }
  // 20 scans know their own rms to 16 %.
  EXPECT_NEAR(std::sqrt(squares / predicted), 1, 0.5);
}

TEST(Artefact, AWrongSizeShowsAsItsError) {
  Scan scan;
  scan.take(50, ball(12.5));
  std::string why_not;
  const auto got = measure_artefact(scan.points, scan.groups, {Artefact::kSphere, 25.4}, why_not);
  ASSERT_TRUE(got) << why_not;
  EXPECT_NEAR(got->size_mm, 25, 0.02);
}

TEST(Artefact, WhatIsNotThereIsSaid) {
  Scan scan;
  scan.take(50, [](double, double) { return -30.0; });
  std::string why_not;
  EXPECT_FALSE(measure_artefact(scan.points, scan.groups, {Artefact::kSphere, 25.4}, why_not));
  EXPECT_EQ(why_not, "no sphere of about 25.4 mm diameter is in the points");
  EXPECT_FALSE(measure_artefact(scan.points, scan.groups, {Artefact::kStep, 12}, why_not));
  EXPECT_EQ(why_not, "no two parallel faces about 12 mm apart are in the points");
  EXPECT_FALSE(measure_artefact({}, {}, {Artefact::kStep, 12}, why_not));
  EXPECT_EQ(why_not, "only 0 points were measured");
}

// A rounded edge is no ball, and two of many faces are no step.
TEST(Artefact, WhatLooksLikeItByChanceIsNotIt) {
  Scan scan;
  scan.take(50, [](double x, double y) { return -30 + 14 * std::exp(-std::abs(y - 3) / 9) + 0.004 * x * x; });
  std::string why_not;
  EXPECT_FALSE(measure_artefact(scan.points, scan.groups, {Artefact::kSphere, 25.4}, why_not));
  EXPECT_EQ(why_not.find("no sphere of"), 0u) << why_not;
  Scan blocks;
  blocks.take(40, block);
  EXPECT_FALSE(measure_artefact(blocks.points, blocks.groups, {Artefact::kStep, 15}, why_not));
  EXPECT_EQ(why_not, "no two parallel faces about 15 mm apart are in the points");
}

}  // namespace
}  // namespace lightstripe
