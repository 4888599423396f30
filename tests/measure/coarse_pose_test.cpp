// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/coarse_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/nominal_outlines.h"
#include "sections.h"

namespace lightstripe {
namespace {

/// Rms distance of the section in a pose, mm.
double misfit(const Section& section, const SectionPose& pose, const ReferenceShape& reference) {
  double sum = 0;
  for (const SectionPoint& p : section) sum += std::pow(reference.coarse_distance(pose * p.position), 2);
  return std::sqrt(sum / static_cast<double>(section.size()));
}

class CoarsePose : public ::testing::Test {
 protected:
  const Outline rail = read_nominal("60E1");
  const ReferenceShape reference{"60E1", ObjectKind::kRail, rail};
};

// Steps of 3 deg and 2 to 4 mm: half of them, on a body of 80 mm, is up to 2 mm.
TEST_F(CoarsePose, ATurnedAndShiftedRailComesToLieOnItself) {
  const Section section = rail_section(rail, {.turn_deg = 6, .shift = {30, -250}});
  const auto poses = coarse_poses(section, reference, {});
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_LT(misfit(section, poses[0], reference), 2);
  EXPECT_NEAR(poses[0].move.angle_rad * 180 / std::numbers::pi, -6, 3.1);
  EXPECT_FALSE(poses[0].mirrored);
}

TEST_F(CoarsePose, UpsideDownIsTriedWhereItMayBe) {
  const Section section = rail_section(rail, {.turn_deg = 180, .shift = {10, 40}});
  CoarsePoseOptions options;
  EXPECT_GT(misfit(section, coarse_poses(section, reference, options)[0], reference), 4);
  options.may_be_upside_down = true;
  EXPECT_LT(misfit(section, coarse_poses(section, reference, options)[0], reference), 2);
}

TEST_F(CoarsePose, AMirroredWheelIsFound) {
  const Outline wheel = read_nominal("S1002");
  const ReferenceShape nominal("S1002", ObjectKind::kWheel, wheel);
  const Section section = wheel_section(wheel, -12, {.shift = {3, 7}}, true);
  CoarsePoseOptions options;
  EXPECT_GT(misfit(section, coarse_poses(section, nominal, options)[0], nominal), 2);
  options.may_mirror = true;
  const SectionPose best = coarse_poses(section, nominal, options)[0];
  EXPECT_TRUE(best.mirrored);
  EXPECT_LT(misfit(section, best, nominal), 2);
}

TEST(SectionPose, MirrorsFirstThenMoves) {
  const SectionPose pose{true, {std::numbers::pi / 2, {10, 20}}};
  const Eigen::Vector2d moved = pose * Eigen::Vector2d(3, 1);  // (-3, 1) turned: (-1, -3)
  EXPECT_NEAR(moved.x(), 9, 1e-12);
  EXPECT_NEAR(moved.y(), 17, 1e-12);
}

}  // namespace
}  // namespace lightstripe
