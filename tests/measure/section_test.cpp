// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightstripe {
namespace {

using Eigen::Vector3d;

/// Points of a plane at an angle to the axis, as a turning object shows them; v the radius.
std::vector<Profile> rotary_profiles() {
  const Vector3d axis_point(3, -20, -540), axis(0.01, -1, 0.02), d = axis.normalized();
  std::vector<Profile> profiles(4);
  for (int frame = 0; frame < 4; ++frame)
    for (int i = 0; i < 60; ++i) {
      const Vector3d p(2.0 * frame + 0.05 * i, i - 30.0, -80 - 0.02 * (i - 30) * (i - 30));
      const Vector3d arm = p - axis_point;
      ProfilePoint point;
      point.position = p;
      point.u = arm.dot(d);
      point.v = (arm - point.u * d).norm();
      profiles[static_cast<std::size_t>(frame)].points.push_back(point);
    }
  return profiles;
}

TEST(Sections, AreRadialWhereThePointsProveAnAxis) { EXPECT_TRUE(sections_are_radial(rotary_profiles())); }

TEST(Sections, OfALinearScanAreNotRadial) {
  std::vector<Profile> profiles = rotary_profiles();
  for (Profile& profile : profiles)
    for (ProfilePoint& point : profile.points) point.u = point.position.y(), point.v = point.position.z();
  EXPECT_FALSE(sections_are_radial(profiles));
}

TEST(Sections, OfPosesAreNotRadial) {  // u, v of the rig, positions in a world that is turned per frame
  std::vector<Profile> profiles = rotary_profiles();
  double turn = 0;
  for (Profile& profile : profiles) {
    turn += 0.7;
    for (ProfilePoint& point : profile.points) {
      point.u = point.position.y(), point.v = point.position.z();
      const Vector3d p = point.position;
      point.position = {std::cos(turn) * p.x() - std::sin(turn) * p.z(), p.y() + 5 * turn,
                        std::sin(turn) * p.x() + std::cos(turn) * p.z()};
    }
  }
  EXPECT_FALSE(sections_are_radial(profiles));
}

TEST(Sections, GlareAndStripeEndsCountLittle) {
  Profile profile;
  for (int i = 0; i < 100; ++i) {
    ProfilePoint point;
    point.u = 0.5 * i;
    point.sigma_mm = i >= 40 && i < 45 ? 0.05 : 0.0025;
    profile.points.push_back(point);
  }
  const Section section = section_of(profile);
  EXPECT_EQ(section[30].weight, 1);
  EXPECT_LT(section[16].weight, 0.5);  // 8 mm from the end
  EXPECT_LT(section[42].weight, 0.02);
  EXPECT_LT(section[2].weight, 0.1);
  EXPECT_LT(section[97].weight, 0.1);
}

}  // namespace
}  // namespace lightstripe
