// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/features.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;

using Curve = std::function<double(double)>;

/// Points every 0.1 mm from u = -30 to 30 with normal noise in v.
Profile section(const Curve& v, double noise = 0, std::uint64_t seed = 1, double travel = 0) {
  Random random(seed);
  Profile profile;
  profile.travel = travel;
  for (int i = 0; i <= 600; ++i) {
    ProfilePoint p;
    p.u = -30 + 0.1 * i;
    p.v = v(p.u) + noise * random.gaussian();
    profile.points.push_back(p);
  }
  return profile;
}

FeatureRecipe feature(const char* name, FeatureType type, std::vector<double> u, const char* anchor = "") {
  FeatureRecipe out;
  out.name = name, out.type = type, out.u = std::move(u), out.anchor = anchor;
  return out;
}

FeatureRecipe crossing(const char* name, const char* a, const char* b) {
  FeatureRecipe out = feature(name, FeatureType::kIntersection, {});
  out.of = {a, b};
  return out;
}

QuantityRecipe quantity(const char* name, QuantityType type, std::vector<std::string> of) {
  QuantityRecipe out;
  out.name = name, out.type = type, out.of = std::move(of);
  return out;
}

/// A step of 2 mm at u = 0 over a plane that leans by 0.1.
double step_at(double u) { return 0.1 * u + (u > 0 ? 2 * std::hypot(1.0, 0.1) : 0); }
/// A roof with its ridge at (3, 5).
double roof(double u) { return 5 - 0.4 * std::abs(u - 3); }
/// A circle's top, radius 50.
double dome(double u) { return std::sqrt(2500 - u * u) - 50; }

FeatureFile step_file() {
  return {
      {feature("low", FeatureType::kLine, {-20, -2}), feature("high", FeatureType::kLine, {2, 20})},
      {quantity("step", QuantityType::kStepHeight, {"low", "high"}),
       quantity("bend", QuantityType::kAngle, {"low", "high"}),
       quantity("lean", QuantityType::kAngle, {"low"}), quantity("flat", QuantityType::kFlatness, {"low"})},
      {}};
}

double value(const MeasuredFeatures& row, std::size_t i) {
  EXPECT_TRUE(row.quantities[i].value) << row.quantities[i].reason;
  return row.quantities[i].value.value_or(-999);
}

TEST(Features, StepAngleAndFlatness) {
  const MeasuredFeatures row = measure_features(section(step_at), step_file());
  EXPECT_NEAR(value(row, 0), 2, 1e-9);
  EXPECT_NEAR(value(row, 1), 0, 1e-6);
  EXPECT_NEAR(value(row, 2), std::atan(0.1) * 180 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(value(row, 3), 0, 1e-9);
}

TEST(Features, KneeIntersectionExtremeAndArc) {
  const FeatureFile file{
      {feature("a", FeatureType::kLine, {-20, 1}), feature("b", FeatureType::kLine, {5, 20}),
       crossing("ridge", "a", "b"), feature("knee", FeatureType::kKnee, {-20, 20})},
      {quantity("u", QuantityType::kPositionU, {"ridge"}), quantity("v", QuantityType::kPositionV, {"ridge"}),
       quantity("knee_u", QuantityType::kPositionU, {"knee"}),
       quantity("off", QuantityType::kDistance, {"ridge", "knee"})},
      {}};
  const MeasuredFeatures row = measure_features(section(roof), file);
  EXPECT_NEAR(value(row, 0), 3, 1e-8);
  EXPECT_NEAR(value(row, 1), 5, 1e-8);
  EXPECT_NEAR(value(row, 2), 3, 0.01);
  EXPECT_NEAR(value(row, 3), 0, 0.01);
  const FeatureFile round{
      {feature("arc", FeatureType::kArc, {-25, 25}), feature("top", FeatureType::kMax, {})},
      {quantity("r", QuantityType::kRadius, {"arc"}), quantity("top_v", QuantityType::kPositionV, {"top"})},
      {}};
  const MeasuredFeatures dome_row = measure_features(section(dome), round);
  EXPECT_NEAR(value(dome_row, 0), 50, 1e-6);
  EXPECT_NEAR(value(dome_row, 1), 0, 1e-4);
}

TEST(Features, GapAndFlushBetweenTheEdgesOfAHole) {
  Profile profile = section([](double u) { return u > 0 ? 0.3 : 0.0; });
  std::erase_if(profile.points, [](const ProfilePoint& p) { return p.u > -1.05 && p.u < 2.45; });
  const FeatureFile file{
      {feature("left", FeatureType::kRightEnd, {-20, 0}), feature("right", FeatureType::kLeftEnd, {0, 20})},
      {quantity("gap", QuantityType::kGap, {"left", "right"}),
       quantity("flush", QuantityType::kFlush, {"left", "right"})},
      {}};
  const MeasuredFeatures row = measure_features(profile, file);
  EXPECT_NEAR(value(row, 0), 3.6, 1e-9);
  EXPECT_NEAR(value(row, 1), 0.3, 1e-9);
}

TEST(Features, AreaBetweenSectionAndLine) {
  // a triangle of 4 mm base and 1 mm height on a plane
  const Profile profile = section([](double u) { return std::max(0.0, 1 - std::abs(u - 10) / 2); });
  FeatureFile file{
      {feature("base", FeatureType::kLine, {-20, 5})}, {quantity("area", QuantityType::kArea, {"base"})}, {}};
  file.measurements[0].u = {10, 30};  // from the line's middle at -7.5
  EXPECT_NEAR(value(measure_features(profile, file), 0), 2, 0.01);
}

TEST(Features, RangesFollowTheirAnchor) {
  FeatureFile file{
      {feature("top", FeatureType::kMax, {}), feature("side", FeatureType::kLine, {4, 20}, "top")},
      {quantity("slope", QuantityType::kAngle, {"side"})},
      {}};
  file.features[0].half_width_mm = 5;
  for (const double shift : {-6.0, 0.0, 6.0}) {
    const auto hill = [shift](double u) {
      return -0.05 * std::pow(std::min(std::abs(u - shift), 3.0), 2) -
             0.3 * std::max(0.0, std::abs(u - shift) - 3);
    };
    EXPECT_NEAR(value(measure_features(section(hill), file), 0), -std::atan(0.3) * 180 / std::numbers::pi,
                0.02);
  }
}

TEST(Features, AMissingFeatureLeavesItsReason) {
  FeatureFile file = step_file();
  file.features[1].u = {40, 50};
  file.measurements[0].max = 3;
  const MeasuredFeatures row = measure_features(section(step_at), file);
  EXPECT_FALSE(row.quantities[0].value);
  EXPECT_THAT(row.quantities[0].reason, HasSubstr("high"));
  EXPECT_TRUE(row.quantities[2].value);
  EXPECT_EQ(row.verdict, "unknown");
}

TEST(Features, LimitsGiveAVerdict) {
  FeatureFile file = step_file();
  file.measurements[0].min = 1.9, file.measurements[0].max = 2.1;
  EXPECT_EQ(measure_features(section(step_at), file).verdict, "pass");
  file.measurements[0].max = 1.95;
  EXPECT_EQ(measure_features(section(step_at), file).verdict, "fail");
}

TEST(Features, ATenthOfOutliersIsLeftOut) {
  Profile profile = section(step_at, 0.01);
  for (std::size_t i = 0; i < profile.points.size(); i += 10) profile.points[i].v += 1;
  EXPECT_NEAR(value(measure_features(profile, step_file()), 0), 2, 0.01);
}

// Nine sigma are no noise: a limit three times as wide would let them lift the upper line by 0.005.
TEST(Features, PointsNineSigmaOffDoNotCount) {
  constexpr int kRepeats = 20;
  double mean = 0;
  for (int k = 0; k < kRepeats; ++k) {
    Profile profile = section(step_at, 0.01, static_cast<std::uint64_t>(k + 1));
    for (std::size_t i = 0; i < profile.points.size(); i += 7)
      if (profile.points[i].u > 0) profile.points[i].v += 0.09;
    mean += value(measure_features(profile, step_file()), 0) / kRepeats;
  }
  EXPECT_NEAR(mean, 2, 0.003);
}

/// What 200 repeats scatter by over what was predicted, and over the least that is possible.
struct Spread {
  double over_predicted = 0, sigma = 0;
};
Spread repeated(const Curve& curve, const FeatureFile& file, std::size_t which, double noise) {
  constexpr int kRepeats = 200;
  double sum = 0, squares = 0, predicted = 0;
  for (int i = 0; i < kRepeats; ++i) {
    const MeasuredFeatures row =
        measure_features(section(curve, noise, static_cast<std::uint64_t>(i + 1)), file);
    const double v = value(row, which);
    sum += v, squares += v * v, predicted += std::pow(*row.quantities[which].sigma, 2) / kRepeats;
  }
  const double variance = (squares - sum * sum / kRepeats) / (kRepeats - 1);
  return {variance / predicted, std::sqrt(variance)};
}

// 200 repeats know a variance to 10 %: a sigma scaled by 0.7 or 1.4 falls out on either side.
void expect_honest(const Spread& spread, const char* what) {
  EXPECT_GT(spread.over_predicted, 0.72) << what;
  EXPECT_LT(spread.over_predicted, 1.35) << what;
}

// Cramer-Rao: a step between two lines of n points over L each has sigma^2 (1/n + 1/n + (D / L)^2 12 / n).
TEST(FeatureSigma, StepAngleAndPosition) {
  const double noise = 0.02;
  const auto flat_step = [](double u) { return u > 0 ? 2.0 : 0.0; };
  const Spread step = repeated(flat_step, step_file(), 0, noise);
  expect_honest(step, "step");
  const double n = 181, length = 18, apart = 22;
  EXPECT_LT(step.sigma, 1.2 * noise * std::sqrt(2 / n + 12 / n * apart * apart / (length * length)));
  expect_honest(repeated(flat_step, step_file(), 2, noise), "lean");
  const FeatureFile file{
      {feature("a", FeatureType::kLine, {-20, 1}), feature("b", FeatureType::kLine, {5, 20}),
       crossing("ridge", "a", "b"), feature("knee", FeatureType::kKnee, {-20, 20})},
      {quantity("u", QuantityType::kPositionU, {"ridge"}),
       quantity("v", QuantityType::kPositionV, {"ridge"})},
      {}};
  expect_honest(repeated(roof, file, 0, noise), "crossing u");
  expect_honest(repeated(roof, file, 1, noise), "crossing v");
}

TEST(FeatureSigma, RadiusAndExtreme) {
  FeatureFile file{
      {feature("arc", FeatureType::kArc, {-25, 25}), feature("top", FeatureType::kMax, {})},
      {quantity("r", QuantityType::kRadius, {"arc"}), quantity("v", QuantityType::kPositionV, {"top"})},
      {}};
  file.features[1].half_width_mm = 5;
  expect_honest(repeated(dome, file, 0, 0.01), "radius");
  expect_honest(repeated(dome, file, 1, 0.01), "top");
}

TEST(FeatureSigma, CorrelatedErrorsAreNotAveragedAway) {
  constexpr int kRepeats = 150;
  double squares = 0, predicted = 0;
  const FeatureFile file = step_file();
  for (int i = 0; i < kRepeats; ++i) {
    Random random(static_cast<std::uint64_t>(i + 1));
    Profile profile = section([](double u) { return u > 0 ? 2.0 : 0.0; });
    double last = 0;
    for (ProfilePoint& p : profile.points) p.v += last = 0.8 * last + 0.6 * 0.02 * random.gaussian();
    const MeasuredFeatures row = measure_features(profile, file);
    squares += std::pow(value(row, 0) - 2, 2) / kRepeats,
        predicted += std::pow(*row.quantities[0].sigma, 2) / kRepeats;
  }
  EXPECT_GT(squares / predicted, 0.6);
  EXPECT_LT(squares / predicted, 1.6);
}

TEST(FeaturesAlong, FlatStraightAndParallel) {
  FeatureFile file = step_file();
  AlongRecipe flat, straight, parallel;
  flat.name = "flat", flat.type = AlongType::kFlatness, flat.of = {"low"};
  straight.name = "straight", straight.type = AlongType::kStraightness, straight.of = {"low"};
  parallel.name = "parallel", parallel.type = AlongType::kParallelism, parallel.of = {"low", "high"};
  file.along = {flat, straight, parallel};
  std::vector<MeasuredFeatures> rows;
  for (int i = 0; i < 5; ++i) {
    const double bow = i == 2 ? 0.5 : 0.0, lift = 0.1 * i;
    rows.push_back(measure_features(
        section([&](double u) { return 0.02 * i + bow + (u > 0 ? 2 + lift : 0.0); }, 0, 1, 10.0 * i), file));
  }
  const std::vector<Estimate> along = measure_along(rows, file);
  // the middle of five is lifted by 0.5: the best line takes a fifth of it, the tilt is taken up
  EXPECT_NEAR(*along[0].value, 0.5, 1e-6);
  EXPECT_NEAR(*along[1].value, 0.5, 1e-6);
  EXPECT_NEAR(*along[2].value, 0.4, 1e-6);
  EXPECT_FALSE(measure_along({rows[0], rows[1]}, file)[0].value);
}

}  // namespace
}  // namespace lightstripe
