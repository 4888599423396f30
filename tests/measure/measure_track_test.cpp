// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Two rails in one section.
#include "measure/measure_track.h"

#include <gmock/gmock.h>

#include <cmath>

#include "estimates.h"
#include "io/nominal_outlines.h"
#include "measure/track_gauge.h"
#include "sections.h"
#include "simulate/worn_rail.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;

class Track : public ::testing::Test {
 protected:
  const Outline nominal = read_nominal("60E1");
  const ReferenceShape reference{"60E1", ObjectKind::kRail, nominal};
  static constexpr double kInclinationDeg = 1.43210;  // 1:40, both rails inwards
  static constexpr double kHalfMm = 755;              // from the track's middle to each rail's own top

  /// Both rails of a canted track.
  Profile profile(const Outline& left, const Outline& right, double cant_deg,
                  const SectionRecipe& left_recipe = {}) const {
    SectionRecipe a = left_recipe, b;
    a.turn_deg = kInclinationDeg, a.shift = {kHalfMm, 0};
    b.turn_deg = -kInclinationDeg, b.shift = {-kHalfMm, 0};
    Section both = rail_section(left, a);
    for (SectionPoint point : rail_section(right, b)) {
      point.sensor += 2, point.chain += 4;
      both.push_back(point);
    }
    for (SectionPoint& point : both)
      point.position =
          Eigen::Rotation2Dd(cant_deg * std::numbers::pi / 180) * point.position + Vector2d(40, -600);
    return profile_of(both);
  }
  static double gauge_by_search(const Outline& left, const Outline& right);
  MeasuredFrame measured(const Profile& profile) const {
    const auto between = place_between_rails({profile});
    EXPECT_TRUE(between);
    MeasureOptions options;
    return measure_track(profile, {reference, reference, between.value_or(0), 0.05}, options);
  }
  /// Of 60E1 at 1:40 the highest point lies 7.497 towards the field, the gauge point 43.03 further in
  /// (computed from the standard's arcs; two decimals).
  static double gauge_of_new_rails() {
    const double a = kInclinationDeg * std::numbers::pi / 180,
                 top_v = std::sqrt(300.0 * 300 - 7.497 * 7.497) - 300;
    return 2 * (kHalfMm + 7.497 * std::cos(a) - top_v * std::sin(a) - 43.03);
  }
};

TEST_F(Track, GaugeIsMeasuredBelowTheRunningPlaneWhateverTheCant) {
  for (const double cant_deg : {0.0, 3.0, -5.0}) {
    const MeasuredFrame row = measured(profile(nominal, nominal, cant_deg));
    EXPECT_EQ(row.status, "ok");
    const Estimate& gauge = estimate_of(row, "gauge");
    ASSERT_TRUE(gauge.value) << gauge.reason;
    EXPECT_NEAR(*gauge.value, gauge_of_new_rails(), 0.02) << cant_deg;
    EXPECT_NEAR(*gauge.sigma, std::sqrt(2.0) * 0.05, 0.01);  // the rig's, the faces add microns
  }
}

TEST_F(Track, SideWearWidensTheGaugeAndBelongsToItsRail) {
  // worn_rail() takes from the face at +u, the right rail's gauge face. 1 mm down moves the gauge point down
  // on a face that leans by 1:20 - 1:40, seen from the running plane: 0.025 narrower at most.
  const Outline worn = worn_rail(nominal, 1, 2);
  const MeasuredFrame row = measured(profile(nominal, worn, 0));
  ASSERT_EQ(row.status, "ok");
  EXPECT_NEAR(gauge_by_search(nominal, nominal), gauge_of_new_rails(), 0.01);
  EXPECT_NEAR(*estimate_of(row, "gauge").value, gauge_by_search(nominal, worn),
              0.03);  // fit_head_face: by how much the corner's end may differ from the face below
  EXPECT_NEAR(*estimate_of(row, "side_wear").value, 0, 0.01);
  EXPECT_NEAR(*estimate_of(row, "right_side_wear").value, 2, 0.01);
  EXPECT_NEAR(*estimate_of(row, "right_vertical_wear").value, 1, 0.01);
}

TEST_F(Track, WithoutAGaugeFaceThereIsNoGauge) {
  const MeasuredFrame row = measured(profile(nominal, nominal, 0, {.left = false}));
  EXPECT_FALSE(estimate_of(row, "gauge").value);
  EXPECT_THAT(estimate_of(row, "gauge").reason, HasSubstr("left gauge face"));
  EXPECT_THAT(row.status, HasSubstr("left rail: "));
}

TEST_F(Track, OneRailIsNoTrack) {
  EXPECT_FALSE(place_between_rails({profile_of(rail_section(nominal, {}))}));
}

/// On the outlines themselves: innermost points from the line through both highest points down to 14 below.
double Track::gauge_by_search(const Outline& left, const Outline& right) {
  std::vector<Vector2d> points[2];
  for (int side = 0; side < 2; ++side)
    for (const OutlineSample& p : sample(side == 0 ? left : right, 0.005)) {
      const double sign = side == 0 ? 1 : -1, turn = sign * kInclinationDeg * std::numbers::pi / 180;
      points[side].push_back(Eigen::Rotation2Dd(turn) * p.position + Vector2d(sign * kHalfMm, 0));
    }
  Vector2d up(0, 1), crest[2];
  for (int round = 0; round < 3; ++round) {
    for (int side = 0; side < 2; ++side)
      crest[side] =
          *std::max_element(points[side].begin(), points[side].end(),
                            [&](const Vector2d& a, const Vector2d& b) { return a.dot(up) < b.dot(up); });
    const Vector2d across = (crest[0] - crest[1]).normalized();
    up = {-across.y(), across.x()};
  }
  const Vector2d across(up.y(), -up.x());
  double innermost[2] = {1e9, -1e9};
  for (const Vector2d& p : points[0])
    if ((p - crest[0]).dot(up) > -14) innermost[0] = std::min(innermost[0], p.dot(across));
  for (const Vector2d& p : points[1])
    if ((p - crest[1]).dot(up) > -14) innermost[1] = std::max(innermost[1], p.dot(across));
  return innermost[0] - innermost[1];
}

}  // namespace
}  // namespace lightstripe
