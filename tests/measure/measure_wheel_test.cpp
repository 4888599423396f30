// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_wheel.h"

#include <gmock/gmock.h>

#include <functional>
#include <map>

#include "core/random.h"
#include "io/nominal_outlines.h"
#include "sections.h"
#include "simulate/worn_wheel.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

class MeasureWheel : public ::testing::Test {
 protected:
  const Outline nominal = read_nominal("S1002");
  const ReferenceShape reference{"S1002", ObjectKind::kWheel, nominal};

  WheelMeasurement measured(const Section& section, const WheelSectionKind& kind = {}) const {
    const SectionPrior prior{.may_mirror = true, .may_be_upside_down = !kind.radial, .upright = kind.radial};
    return measure_wheel(section, reference, register_section(section, reference, prior), kind);
  }
};

double value(const Estimate& estimate) {
  EXPECT_TRUE(estimate.value) << estimate.reason;
  return estimate.value.value_or(-999);
}

// The standard's figures of a new wheel. 0.002: parabolas on arcs, spacing 0.3 mm.
TEST_F(MeasureWheel, ANewWheelHasTheStandardsFigures) {
  for (const bool mirrored : {false, true}) {
    const WheelMeasurement wheel =
        measured(wheel_section(nominal, -30, {.turn_deg = 1, .shift = {300, 10}}, mirrored));
    EXPECT_NEAR(value(wheel.flange_height), 28.000, 0.003);
    EXPECT_NEAR(value(wheel.flange_thickness), 32.500, 0.005);
    EXPECT_NEAR(value(wheel.qr), 10.794, 0.01);
    EXPECT_NEAR(value(wheel.tread_wear), 0, 0.003);
    EXPECT_NEAR(value(wheel.hollow), 0, 0.01);
    EXPECT_NEAR(value(wheel.rim_width), 135, 0.005);
    EXPECT_FALSE(wheel.diameter.value);
    EXPECT_THAT(wheel.diameter.reason, HasSubstr("not a rotary scan"));
  }
}

TEST_F(MeasureWheel, ARotaryScanKnowsTheDiameter) {
  WheelSectionKind kind{.radial = true, .axis_sigma_mm = 0.2};
  const WheelMeasurement wheel = measured(wheel_section(nominal, -30, {.shift = {20, 460}}, true), kind);
  EXPECT_NEAR(value(wheel.diameter), 920, 0.005);
  EXPECT_NEAR(*wheel.diameter.sigma, 0.4, 0.01);
  EXPECT_NEAR(value(wheel.flange_height), 28.000, 0.003);
}

// Tread lowered by 2 between u = -20 and 40 (blended by the shape's own points), flange untouched.
TEST_F(MeasureWheel, AHollowTreadIsFound) {
  Section section = wheel_section(nominal, -30, {});
  for (SectionPoint& p : section) {
    const double t = (p.position.x() - 5) / 30;
    if (std::abs(t) < 1 && p.position.y() > -10 && p.position.y() < 6) p.position.y() -= 2 * (1 - t * t);
  }
  const WheelMeasurement wheel = measured(section);
  EXPECT_NEAR(value(wheel.flange_height), 28 + 2 * (1 - 25.0 / 900), 0.01);
  EXPECT_NEAR(value(wheel.tread_wear), 2 * (1 - 25.0 / 900), 0.01);
  EXPECT_GT(value(wheel.hollow), 0.8);
  EXPECT_LT(value(wheel.hollow), 1.6);
}

// Against the full S1002: the section's own figures, by the definitions, of the simulator's outline.
TEST_F(MeasureWheel, AWornOrThinnerFlangeIsMeasuredByItself) {
  for (const WheelWear wear : {WheelWear{2, 1.5}, WheelWear{4, 0}, WheelWear{8, 3}}) {
    const Outline worn = worn_wheel(nominal, wear);
    const WheelDimensions truth = measure_wheel_section(worn);
    const WheelMeasurement wheel = measured(wheel_section(worn, -30, {.spacing_mm = 0.2, .shift = {3, 8}}));
    EXPECT_NEAR(value(wheel.flange_height), truth.flange_height, 0.005) << wear.flange_mm;
    EXPECT_NEAR(value(wheel.flange_thickness), truth.flange_thickness, 0.005) << wear.flange_mm;
    EXPECT_NEAR(value(wheel.qr), truth.qr, 0.02)
        << wear.flange_mm;  // parabola over 1.6 mm of a face that bends
  }
}

TEST_F(MeasureWheel, WhatIsNotSeenIsUnknown) {
  Section no_tip = wheel_section(nominal, -30, {});
  std::erase_if(no_tip, [](const SectionPoint& p) { return p.position.y() > 25; });
  const WheelMeasurement without_tip = measured(no_tip);
  EXPECT_FALSE(without_tip.flange_height.value);
  EXPECT_FALSE(without_tip.qr.value);
  Section no_rim = wheel_section(nominal, -2, {});
  const WheelMeasurement without_rim = measured(no_rim);
  EXPECT_FALSE(without_rim.rim_width.value);
  EXPECT_NEAR(value(without_rim.flange_thickness), 32.5, 0.01);
}

/// In the file's frame: the wheel's back and the datum's height are given, as in a recorded profile.
WheelMeasurement in_its_frame(const Section& section, const ReferenceShape& reference) {
  SectionPrior prior;
  prior.pose = SectionPose{};
  return measure_wheel(section, reference, register_section(section, reference, prior),
                       {.back_is_given = true});
}

// Against S1002: the worn ones keep their tread wear; a new wheel with a flange of 32, whose tread fits to
// the rim, and one with another flange do not.
TEST_F(MeasureWheel, AnotherWheelHasNoTreadWearButAReason) {
  for (const WheelWear wear : {WheelWear{0, 0}, WheelWear{2, 1.5}, WheelWear{3, 4}}) {
    Section worn = wheel_section(worn_wheel(nominal, wear), -30, {.spacing_mm = 0.2});
    for (SectionPoint& p : worn) p.position.y() += wear.tread_mm;  // the datum at 0
    EXPECT_NEAR(value(in_its_frame(worn, reference).tread_wear), wear.tread_mm, 0.01);
  }
  Section higher = wheel_section(nominal, -30, {}), broader = higher;
  for (SectionPoint& p : higher) p.position.y() += 4 * std::clamp((p.position.y() - 5) / 11, 0.0, 1.0);
  for (SectionPoint& p : broader)
    if (p.position.y() > 8) p.position.x() += 0.3 * (p.position.y() - 8) / 20 * 16;
  const WheelMeasurement other = in_its_frame(higher, reference), odd = in_its_frame(broader, reference);
  EXPECT_FALSE(other.tread_wear.value);
  EXPECT_THAT(other.tread_wear.reason, HasSubstr("4.0 mm lower than S1002's out to the rim"));
  EXPECT_NEAR(value(other.flange_height), 32, 0.01);
  EXPECT_FALSE(odd.tread_wear.value);
  EXPECT_THAT(odd.tread_wear.reason, HasSubstr("flange's top does not fit S1002"));
}

/// Of many noisy measurements of one wheel: what each quantity scatters by, over what it is said to.
std::map<std::string, double> scatter_over_sigma(
    const std::function<WheelMeasurement(std::uint64_t)>& measure, int repeats) {
  std::map<std::string, std::vector<Estimate>> all;
  for (int i = 0; i < repeats; ++i) {
    WheelMeasurement wheel = measure(static_cast<std::uint64_t>(i + 1));
    visit_estimates(
        [&](const char* name, Estimate& estimate) {
          if (estimate.value && estimate.sigma) all[name].push_back(estimate);
        },
        wheel);
  }
  std::map<std::string, double> out;
  for (const auto& [name, estimates] : all) {
    const auto n = static_cast<double>(estimates.size());
    double mean = 0, scatter = 0, said = 0;
    for (const Estimate& e : estimates) mean += *e.value / n;
    for (const Estimate& e : estimates)
      scatter += (*e.value - mean) * (*e.value - mean) / (n - 1), said += *e.sigma * *e.sigma / n;
    out[name] = std::sqrt(scatter / said);
  }
  return out;
}

// Independent noise, and stripes that bend over one millimetre and over several. 150 repeats know a scatter
// to 6 %; a sigma that is 0.7 or 1.4 times the right one is outside.
TEST_F(MeasureWheel, SigmasAreWhatTheQuantitiesScatterByAlsoOnBentStripes) {
  const Outline worn = worn_wheel(nominal, {.flange_mm = 1, .tread_mm = 3});
  for (const SectionRecipe& recipe :
       {SectionRecipe{.spacing_mm = 0.25, .noise_mm = 0.02},
        SectionRecipe{.spacing_mm = 0.15, .noise_mm = 0.01, .bend_mm = 0.02, .bend_length_mm = 0.7},
        SectionRecipe{.spacing_mm = 0.15, .noise_mm = 0.01, .bend_mm = 0.02, .bend_length_mm = 3},
        SectionRecipe{.spacing_mm = 0.15, .noise_mm = 0.01, .bend_mm = 0.02, .bend_length_mm = 6},
        SectionRecipe{.spacing_mm = 0.15, .noise_mm = 0.01, .bend_mm = 0.02, .bend_length_mm = 12}}) {
    const auto ratios = scatter_over_sigma(
        [&](std::uint64_t seed) {
          SectionRecipe one = recipe;
          one.seed = seed;
          return measured(wheel_section(worn, -30, one));
        },
        150);
    for (const std::string name :
         {"flange_height", "flange_thickness", "qr", "hollow", "tread_wear", "rim_width"}) {
      EXPECT_GT(ratios.at(name), 0.72) << name << ", bent over " << recipe.bend_length_mm;
      EXPECT_LT(ratios.at(name), 1.25) << name << ", bent over " << recipe.bend_length_mm;
    }
  }
}

// A bend in grain is less well known than what is straight: the flange's points scatter by twice the others'
// noise, and say so.
TEST_F(MeasureWheel, SigmasFollowWhatThePointsOfAPlaceAreSaidToErrBy) {
  constexpr double kNoiseMm = 0.02, kOfFlangeMm = 0.04;
  const auto ratios = scatter_over_sigma(
      [&](std::uint64_t seed) {
        Section section =
            wheel_section(nominal, -30, {.spacing_mm = 0.25, .noise_mm = kNoiseMm, .seed = seed});
        Random random(seed + 1000);
        for (SectionPoint& p : section) {
          const bool on_flange = p.position.y() > 5;
          p.sigma_mm = on_flange ? kOfFlangeMm : kNoiseMm;
          const double more = std::sqrt(kOfFlangeMm * kOfFlangeMm - kNoiseMm * kNoiseMm);
          if (on_flange) p.position += more * Eigen::Vector2d(random.gaussian(), random.gaussian());
        }
        return measured(section);
      },
      150);
  // 0.68: the height's error is that of the section's points together, which the flange's raise already.
  for (const std::string name : {"flange_height", "flange_thickness", "qr"}) {
    EXPECT_GT(ratios.at(name), 0.6) << name;
    EXPECT_LT(ratios.at(name), 1.15) << name;
  }
}

}  // namespace
}  // namespace lightstripe
