// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_rail.h"

#include <gmock/gmock.h>

#include "io/nominal_outlines.h"
#include "measure/overlap_gap.h"
#include "sections.h"
#include "simulate/worn_rail.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;

class MeasureRail : public ::testing::Test {
 protected:
  const Outline nominal = read_nominal("60E1");
  const ReferenceShape reference{"60E1", ObjectKind::kRail, nominal};

  RailMeasurement measured(const Section& section, const RailOptions& options = {}) const {
    return measure_rail(section, reference, register_section(section, reference), options);
  }
  RailMeasurement measured(const Outline& rail, const SectionRecipe& recipe = {}) const {
    return measured(rail_section(rail, recipe));
  }
};

double value(const Estimate& estimate) {
  EXPECT_TRUE(estimate.value) << estimate.reason;
  return estimate.value.value_or(-999);
}

double reach(const Outline& rail, const Vector2d& origin, const Vector2d& outwards) {
  return 200 - first_hit(rail, origin + 200 * outwards, -outwards, 0)->s;
}

// Without noise: 2e-4 mm of the polyline, 1e-3 of the fits.
TEST_F(MeasureRail, ANewRailHasNoWear) {
  const RailMeasurement rail = measured(nominal);
  EXPECT_NEAR(value(rail.vertical_wear), 0, 0.002);
  EXPECT_NEAR(value(rail.side_wear), 0, 0.002);
  EXPECT_NEAR(value(rail.corner45_wear), 0, 0.002);
  EXPECT_NEAR(value(rail.head_width), 71.963, 0.003);  // published, 14 mm below the top
  EXPECT_NEAR(value(rail.head_area_loss), 0, 0.5);
  EXPECT_NEAR(value(rail.gauge_face_angle), 2.8624, 0.01);  // 1:20
  EXPECT_NEAR(value(rail.inclination), 0, 0.002);
  EXPECT_NEAR(value(rail.crown_radius), 300, 3);
  EXPECT_EQ(value(rail.lip), 0);
}

TEST_F(MeasureRail, WearIsWhatTheOutlineLost) {
  for (const auto& [vertical, side] : {std::pair{0.5, 0.0}, {0.0, 1.0}, {3.0, 3.0}, {8.0, 5.0}}) {
    const Outline worn = worn_rail(nominal, vertical, side);
    const RailMeasurement rail = measured(worn, {.turn_deg = 1.43, .shift = {4, -250}});
    EXPECT_NEAR(value(rail.vertical_wear), vertical, 0.004) << vertical << " " << side;
    EXPECT_NEAR(value(rail.side_wear), side, 0.012)
        << vertical << " " << side;  // the worn corner's end is near
    EXPECT_NEAR(value(rail.inclination), 1.43, 0.003);
    const double lost = section_properties(nominal).area - section_properties(worn).area;
    // What the face loses below the head's widest place (3 mm of its height) is not counted.
    EXPECT_NEAR(value(rail.head_area_loss), lost, 0.02 * lost + 3.5 * side + 0.6) << vertical << " " << side;
    const Vector2d out = Vector2d(1, 1).normalized();
    const Vector2d corner(36 - 13 + 13 * out.x() + 0.0, -14.949 + 13 * out.y());
    EXPECT_NEAR(value(rail.corner45_wear), reach(nominal, corner, out) - reach(worn, corner, out), 0.02);
  }
}

// A hole of 3 mm in the worn corner is bridged, one of 12 mm is too much.
TEST_F(MeasureRail, HeadAreaIsKnownAcrossAGlareButNotAcrossTheWholeCorner) {
  const Outline worn = worn_rail(nominal, 3, 2);
  const double whole = value(measured(worn).head_area_loss);
  for (const double half_mm : {1.5, 6.0}) {
    Section section = rail_section(worn, {});
    const Vector2d corner(29, -7.5);
    std::erase_if(section, [&](const SectionPoint& p) { return (p.position - corner).norm() < half_mm; });
    const Estimate area = measured(section).head_area_loss;
    if (half_mm > 3) {
      EXPECT_FALSE(area.value);
    } else {
      EXPECT_NEAR(value(area), whole, 1.5);  // the difference bends by half a millimetre over 3 mm
    }
  }
}

TEST_F(MeasureRail, SideWearFollowsTheGaugeSide) {
  const Section section = rail_section(worn_rail(nominal, 1, 2), {});
  EXPECT_NEAR(value(measured(section, {.gauge_side = GaugeSide::kLeft}).side_wear), 2, 0.01);
  EXPECT_NEAR(value(measured(section, {.gauge_side = GaugeSide::kRight}).side_wear), 0, 0.01);
}

// Face 1:20: 8 mm higher or lower makes the new rail 2 x 0.4 mm narrower or wider.
TEST_F(MeasureRail, GaugePointCountsFromTheMeasuredOrTheUnwornTop) {
  const Section section = rail_section(worn_rail(nominal, 8, 0), {});
  const double floating = value(measured(section).head_width);
  const double fixed =
      value(measured(section, {.gauge_point_mm = 22, .gauge_height = GaugeHeight::kUnwornTop}).head_width);
  EXPECT_NEAR(floating, 71.963 + 2 * 8.0 / 20 + 0.009, 0.02);
  EXPECT_NEAR(fixed, floating, 0.01);
}

TEST_F(MeasureRail, OneSideLeavesTheWidthUnknown) {
  const RailMeasurement rail = measured(worn_rail(nominal, 2, 1), {.left = false});
  EXPECT_NEAR(value(rail.vertical_wear), 2, 0.01);
  EXPECT_NEAR(value(rail.side_wear), 1, 0.02);
  EXPECT_FALSE(rail.head_width.value);
  EXPECT_THAT(rail.head_width.reason, HasSubstr("-y"));
  EXPECT_FALSE(rail.head_area_loss.value);
}

// A head alone, turned, new and worn: its own width and radius, and no wear.
TEST_F(MeasureRail, AHeadAloneHasAWidthAndARadiusButNoWear) {
  for (const auto& [vertical, side] : {std::pair{0.0, 0.0}, {1.0, 0.3}}) {
    const Outline worn = worn_rail(nominal, vertical, side);
    Section section = rail_section(worn, {.noise_mm = 0.01, .lower_part = false});
    std::erase_if(section, [](const SectionPoint& p) { return p.position.y() < -34; });
    for (SectionPoint& p : section) p.position = Eigen::Rotation2Dd(0.03) * p.position + Vector2d(5, -200);
    const RailMeasurement rail = measured(section);
    EXPECT_NEAR(value(rail.head_width),
                reach(worn, {0, -14 - vertical}, {1, 0}) + reach(worn, {0, -14 - vertical}, {-1, 0}), 0.05)
        << vertical;
    EXPECT_NEAR(value(rail.crown_radius), 300, 15);
    for (const Estimate& wear : {rail.vertical_wear, rail.side_wear, rail.head_area_loss, rail.inclination}) {
      EXPECT_FALSE(wear.value);
      EXPECT_THAT(wear.reason, HasSubstr("head only"));
    }
  }
}

TEST_F(MeasureRail, AHoleInTheCrownLeavesVerticalWearUnknown) {
  Section section = rail_section(nominal, {});
  std::erase_if(section,
                [](const SectionPoint& p) { return std::abs(p.position.x()) < 5 && p.position.y() > -5; });
  const RailMeasurement rail = measured(section);
  EXPECT_FALSE(rail.vertical_wear.value);
  EXPECT_FALSE(rail.vertical_wear.reason.empty());
}

TEST_F(MeasureRail, ALipIsFoundAndDoesNotCountAsWear) {
  Section section = rail_section(nominal, {});
  for (SectionPoint& p : section)
    if (p.position.x() > 30 && p.position.y() < -30 && p.position.y() > -34) p.position.x() += 1.0;
  const RailMeasurement rail = measured(section);
  EXPECT_NEAR(value(rail.lip), 1.0, 0.02);
  EXPECT_NEAR(value(rail.side_wear), 0, 0.01);
}

TEST_F(MeasureRail, OverlapGapIsTheDifferenceOfTheSensors) {
  Section section = rail_section(nominal, {.noise_mm = 0.01});
  for (SectionPoint& p : section)
    if (p.sensor == 0) p.position.y() += 0.08;
  const Registration registration = register_section(section, reference);
  const Estimate gap = overlap_gap(place(section, reference, registration));
  EXPECT_NEAR(value(gap), 0.08, 0.008);
  const Section half = rail_section(nominal, {.left = false});
  EXPECT_FALSE(overlap_gap(place(half, reference, register_section(half, reference))).value);
}

// 120 noisy repeats: empirical over predicted variance, within what 120 repeats and the model allow.
TEST_F(MeasureRail, SigmasCoverTheErrors) {
  const Outline worn = worn_rail(nominal, 2, 1.5);
  double vertical = 0, side = 0, width = 0;
  constexpr int kRepeats = 120;
  const double true_width = reach(worn, {0, -16}, {1, 0}) + reach(worn, {0, -16}, {-1, 0});
  for (int i = 0; i < kRepeats; ++i) {
    const RailMeasurement rail =
        measured(worn, {.noise_mm = 0.03, .seed = static_cast<std::uint64_t>(i + 1)});
    vertical += std::pow((value(rail.vertical_wear) - 2) / *rail.vertical_wear.sigma, 2) / kRepeats;
    side += std::pow((value(rail.side_wear) - 1.5) / *rail.side_wear.sigma, 2) / kRepeats;
    width += std::pow((value(rail.head_width) - true_width) / *rail.head_width.sigma, 2) / kRepeats;
  }
  for (const double ratio : {vertical, side, width}) {
    EXPECT_GT(ratio, 0.3);  // the stretch error is meant for scans with a calibration's error as well
    EXPECT_LT(ratio, 1.6);
  }
}

// The area of an unworn rail is nothing on average, and its sigma is what it scatters by: 60 repeats know the
// variance to 18 %. Two points a sector are the hard case: their median must be their mean.
TEST_F(MeasureRail, HeadAreaLossOfANewRailIsNothingAndItsSigmaHonest) {
  constexpr int kRepeats = 60;
  for (const double spacing : {0.1, 0.25}) {
    double sum = 0, squares = 0, predicted = 0;
    for (int i = 0; i < kRepeats; ++i) {
      const Estimate area = measured(rail_section(nominal, {.spacing_mm = spacing,
                                                            .noise_mm = 0.02,
                                                            .seed = static_cast<std::uint64_t>(i + 1)}))
                                .head_area_loss;
      sum += value(area), squares += value(area) * value(area),
          predicted += *area.sigma * *area.sigma / kRepeats;
    }
    const double mean = sum / kRepeats, variance = (squares - sum * mean) / (kRepeats - 1);
    EXPECT_LT(std::abs(mean), 0.6 * std::sqrt(predicted)) << spacing;
    EXPECT_GT(variance / predicted, 0.55) << spacing;
    EXPECT_LT(variance / predicted, 1.7) << spacing;
  }
}

}  // namespace
}  // namespace lightstripe
