// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

/// A 4 x 2 rectangle whose upper right corner is rounded with radius 1; lower left corner at the origin.
Outline rounded_rectangle() {
  return {{line_segment({0, 0}, {4, 0}), line_segment({4, 0}, {4, 1}), arc_segment({4, 1}, {3, 2}, {3, 1}),
           line_segment({3, 2}, {0, 2}), line_segment({0, 2}, {0, 0})}};
}

TEST(Outline, RayMeetsALineWhereAHandCalculationSays) {
  const auto hit = first_hit(rounded_rectangle(), {-2, 0.5}, {2, 0.25}, 0);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->s, 1);
  EXPECT_EQ(hit->segment, 4);
  EXPECT_EQ(hit->normal, Vector2d(-1, 0));
}

TEST(Outline, RayMeetsTheArcFromOutsideAndFromInside) {
  const Vector2d diagonal(std::sqrt(0.5), std::sqrt(0.5));
  const auto outside = first_hit(rounded_rectangle(), Vector2d(3, 1) + 3 * diagonal, -diagonal, 0);
  ASSERT_TRUE(outside);
  EXPECT_NEAR(outside->s, 2, 1e-14);
  EXPECT_EQ(outside->segment, 2);
  EXPECT_NEAR((outside->normal - diagonal).norm(), 0, 1e-14);
  const auto inside = first_hit(rounded_rectangle(), {3, 1}, 2 * diagonal, 0);
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->s, 0.5, 1e-14);
  EXPECT_EQ(inside->segment, 2);
}

TEST(Outline, RayThroughTheRestOfAnArcsCirclePassesOn) {
  // Leaves through the left wall, not through the left half of the corner's circle.
  const auto hit = first_hit(rounded_rectangle(), {3, 1.2}, {-1, 0}, 0);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->s, 3);
  EXPECT_EQ(hit->segment, 4);
}

TEST(Outline, MinSSkipsTheFirstCrossing) {
  const auto hit = first_hit(rounded_rectangle(), {-1, 1}, {1, 0}, 1.5);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->s, 5);
}

TEST(Outline, NoRayLeaksThroughAJoint) {
  const Outline outline = rounded_rectangle();
  Random random(1);
  for (const OutlineSegment& segment : outline.segments)
    for (int i = 0; i < 1000; ++i) {
      const Vector2d inside(random.uniform(0.5, 2.5), random.uniform(0.2, 1.8));
      const Vector2d aim = segment.to + 1e-9 * Vector2d(random.gaussian(), random.gaussian());
      const auto hit = first_hit(outline, inside, aim - inside, 0);
      ASSERT_TRUE(hit);
      ASSERT_NEAR(hit->s, 1, 1e-6);
    }
}

TEST(Outline, MissesGiveNothing) {
  EXPECT_FALSE(first_hit(rounded_rectangle(), {-1, 3}, {1, 0}, 0));
  EXPECT_FALSE(first_hit(rounded_rectangle(), {-1, 1}, {-1, 0}, 0));
  EXPECT_FALSE(first_hit(rounded_rectangle(), {3.9, 2.5}, {1, -1}, 0));  // cuts the corner's corner only
}

TEST(Outline, ContainsTellsInsideFromOutsideOnBothSidesOfTheArc) {
  const Outline outline = rounded_rectangle();
  EXPECT_TRUE(contains(outline, {1, 1}));
  EXPECT_TRUE(contains(outline, {3.7, 1.7}));     // between chord and arc: 0.99 from the centre
  EXPECT_FALSE(contains(outline, {3.72, 1.72}));  // 1.018 from the centre
  EXPECT_FALSE(contains(outline, {5, 1}));
  EXPECT_FALSE(contains(outline, {1, -0.1}));
  EXPECT_TRUE(contains(circle_outline(2), {-1.99, 0}));  // on both arcs' chord
  EXPECT_FALSE(contains(circle_outline(2), {-1.5, 1.5}));
}

TEST(Outline, ClosestPointIsFootOrEnd) {
  const Outline outline = rounded_rectangle();
  const OutlineFoot below = closest_point(outline, {2, -3});
  EXPECT_EQ(below.position, Vector2d(2, 0));
  EXPECT_DOUBLE_EQ(below.distance, 3);
  EXPECT_EQ(below.normal, Vector2d(0, -1));
  const OutlineFoot corner = closest_point(outline, {-3, -4});
  EXPECT_EQ(corner.position, Vector2d(0, 0));
  EXPECT_DOUBLE_EQ(corner.distance, 5);
  const OutlineFoot arc = closest_point(outline, {6, 5});  // direction (3, 4) from the arc's centre
  EXPECT_NEAR((arc.position - Vector2d(3.6, 1.8)).norm(), 0, 1e-14);
  EXPECT_NEAR(arc.distance, 4, 1e-14);
  EXPECT_EQ(arc.segment, 2);
}

TEST(Outline, ClosestPointAgreesWithDenseSamples) {
  const Outline outline = rounded_rectangle();
  const auto points = sample(outline, 1e-3);
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vector2d p(random.uniform(-2, 6), random.uniform(-2, 4));
    double nearest = 1e9;
    for (const OutlineSample& point : points) nearest = std::min(nearest, (point.position - p).norm());
    EXPECT_NEAR(closest_point(outline, p).distance, nearest,
                6e-4);  // half the spacing at worst, for p on the outline
  }
}

TEST(Outline, SectionPropertiesOfARectangleAndACircle) {
  const SectionProperties rectangle = section_properties(polygon_outline({{1, 1}, {1, 4}, {7, 4}, {7, 1}}));
  EXPECT_NEAR(rectangle.area, 18, 1e-12);
  EXPECT_NEAR((rectangle.centroid - Vector2d(4, 2.5)).norm(), 0, 1e-12);
  EXPECT_NEAR(rectangle.inertia_u, 6 * 27 / 12.0, 1e-12);
  EXPECT_NEAR(rectangle.inertia_v, 3 * 216 / 12.0, 1e-12);
  const SectionProperties circle = section_properties(circle_outline(3));
  EXPECT_NEAR(circle.area, 9 * kPi, 1e-12);
  EXPECT_NEAR(circle.inertia_u, 81 * kPi / 4, 1e-11);
  EXPECT_NEAR(circle.inertia_v, 81 * kPi / 4, 1e-11);
}

TEST(Outline, RoundedCornerTakesAwayWhatASquareHasMoreThanAQuarterCircle) {
  EXPECT_NEAR(section_properties(rounded_rectangle()).area, 8 - (1 - kPi / 4), 1e-13);
}

TEST(Outline, MirroredHalfMakesTheWholeCounterclockwise) {
  const Outline half{
      {line_segment({0, 2}, {3, 2}), line_segment({3, 2}, {3, 0}), line_segment({3, 0}, {0, 0})}};
  const Outline whole = mirrored(half);
  EXPECT_TRUE(whole.closed());
  const SectionProperties properties = section_properties(whole);
  EXPECT_NEAR(properties.area, 12, 1e-13);  // positive: counterclockwise
  EXPECT_NEAR(properties.centroid.x(), 0, 1e-13);
}

TEST(Outline, SamplesLieOnTheOutlineWithOutwardNormals) {
  const Outline outline = rounded_rectangle();
  const auto points = sample(outline, 0.05);
  double expected = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const OutlineSample& point = points[i];
    EXPECT_LT(closest_point(outline, point.position).distance, 1e-13);
    EXPECT_FALSE(contains(outline, point.position + 1e-6 * point.normal));
    const OutlineSegment& segment = outline.segments[static_cast<std::size_t>(point.segment)];
    if (point.position != segment.from) {
      EXPECT_TRUE(contains(outline, point.position - 1e-6 * point.normal));
    }
    const Vector2d next = points[(i + 1) % points.size()].position;
    EXPECT_LE((next - point.position).norm(), 0.05 + 1e-12);
    EXPECT_NEAR(point.arc_length, expected, 1e-12);
    if (i + 1 < points.size()) expected = points[i + 1].arc_length;
  }
  EXPECT_NEAR(points.back().arc_length, 4 + 1 + kPi / 2 + 3 + 2, 0.0501);
}

}  // namespace
}  // namespace lightstripe
