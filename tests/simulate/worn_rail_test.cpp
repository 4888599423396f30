// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/worn_rail.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/nominal_outlines.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

double top_at(const Outline& rail, double u) { return 50 - first_hit(rail, {u, 50}, {0, -1}, 0)->s; }
double gauge_face_at(const Outline& rail, double v) { return 500 - first_hit(rail, {500, v}, {-1, 0}, 0)->s; }
double field_face_at(const Outline& rail, double v) {
  return -500 + first_hit(rail, {-500, v}, {1, 0}, 0)->s;
}

class WornRail : public ::testing::Test {
 protected:
  const Outline nominal = read_nominal("60E1");
};

TEST_F(WornRail, WithoutWearIsTheNominalOutline) {
  const Outline rail = worn_rail(nominal, 0, 0);
  EXPECT_EQ(rail.segments.size(), nominal.segments.size());
  EXPECT_EQ(rail.segments[3].to, nominal.segments[3].to);
}

TEST_F(WornRail, VanishingWearIsTheNominalOutlineWithinItsRounding) {
  const Outline rail = worn_rail(nominal, 1e-9, 1e-9);
  for (const OutlineSample& point : sample(rail, 0.5))
    EXPECT_LT(closest_point(nominal, point.position).distance, 1e-4);
}

TEST_F(WornRail, TopIsLoweredByTheVerticalWear) {
  const Outline rail = worn_rail(nominal, 3, 2);
  EXPECT_NEAR(top_at(rail, 0), -3, 1e-5);
  for (const double u : {-20.0, -5.0, 8.0, 18.0})
    EXPECT_NEAR(top_at(rail, u), top_at(nominal, u) - 3, 1e-9) << u;
}

TEST_F(WornRail, GaugeFaceMovesInAndFieldFaceStays) {
  const Outline rail = worn_rail(nominal, 3, 2);
  for (const double v : {-18.0, -25.0, -34.0}) {
    EXPECT_NEAR(gauge_face_at(rail, v), gauge_face_at(nominal, v) - 2, 1e-4) << v;
    EXPECT_NEAR(field_face_at(rail, v), field_face_at(nominal, v), 1e-9) << v;
  }
}

TEST_F(WornRail, EverythingBelowTheHeadStays) {
  const Outline rail = worn_rail(nominal, 3, 2);
  for (const OutlineSample& point : sample(nominal, 1))
    if (point.position.y() < -39) {
      EXPECT_LT(closest_point(rail, point.position).distance, 1e-9);
    }
}

TEST_F(WornRail, CornersAreTangentAgainAndHaveTheNominalRadius) {
  const Outline rail = worn_rail(nominal, 4, 5);
  const auto& s = rail.segments;
  const std::size_t n = s.size();
  for (const std::size_t corner : {std::size_t{2}, n - 3}) {
    EXPECT_NEAR(s[corner].radius, 13, 1e-4);
    EXPECT_NEAR((normal_at(s[corner - 1], 1) - normal_at(s[corner], 0)).norm(), 0, 1e-6);
    EXPECT_NEAR((normal_at(s[corner], 1) - normal_at(s[corner + 1], 0)).norm(), 0, 1e-6);
  }
}

TEST_F(WornRail, IsClosedAndSmaller) {
  const double whole = section_properties(nominal).area;
  double before = whole;
  for (const double wear : {0.5, 1.0, 2.0, 4.0, 8.0}) {  // the lower corner goes between 1 and 2 mm
    const Outline rail = worn_rail(nominal, wear, wear);
    for (std::size_t i = 0; i < rail.segments.size(); ++i)
      EXPECT_LT((rail.segments[i].to - rail.segments[(i + 1) % rail.segments.size()].from).norm(), 1e-9)
          << wear;
    const double area = section_properties(rail).area;
    EXPECT_LT(area, before);
    // Roughly the head's width times the vertical and the face's height times the side wear.
    EXPECT_NEAR(whole - area, wear * 72 + wear * 36, 0.15 * wear * 108) << wear;
    before = area;
  }
}

TEST_F(WornRail, TooMuchWearIsRefused) {
  EXPECT_THROW(worn_rail(nominal, 0, 25), Error);
  EXPECT_THROW(worn_rail(nominal, 24, 0), Error);
  EXPECT_THROW(worn_rail(circle_outline(20), 1, 1), Error);
}

}  // namespace
}  // namespace lightstripe
