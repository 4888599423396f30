// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a calibration says about its own errors.
#include "calib/assess/diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/calibrate_rig.h"
#include "section_error.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;
using testing::observe;
using testing::rail_rig;

CalibrationOptions brown4() {
  CalibrationOptions options;
  options.lens = LensModel::kBrown4;
  options.board_warp = true;
  return options;
}

/// A rig that brown4 describes exactly.
testing::SyntheticRig plain_rig(int sensors, std::uint64_t seed) {
  auto rig = rail_rig(sensors, seed);
  for (auto& sensor : rig.sensors) sensor.camera.distortion[4] = 0;
  return rig;
}

CalibrationResult calibrated(const testing::SyntheticRig& rig, const testing::SessionOptions& options) {
  auto result = calibrate_rig(observe(rig, options), brown4());
  EXPECT_TRUE(result.diagnosis) << result.summary.message;
  return result;
}

TEST(UncertaintyMap, CoversTheMeasuringVolumeAndGrowsBeyondTheBoards) {
  const auto result = calibrated(plain_rig(2, 0), {});
  double inside = 0, beyond = 0;
  int num_inside = 0, num_beyond = 0;
  for (const auto& cell : result.diagnosis->map) {
    EXPECT_GT(cell.absolute_mm, 0);
    EXPECT_GT(cell.shape_mm, 0);
    (cell.extrapolated ? beyond : inside) += cell.shape_mm * cell.shape_mm;
    ++(cell.extrapolated ? num_beyond : num_inside);
  }
  ASSERT_GT(num_inside, 100);
  ASSERT_GT(num_beyond, 5);
  inside = std::sqrt(inside / num_inside);
  // The same quantity as from the stripe points, but evenly over the volume and up to its border, where few
  // stripes lay: larger, of the same order.
  EXPECT_GT(inside, 0.9 * result.rig.quality.section_shape_sigma_mm);
  EXPECT_LT(inside, 3 * result.rig.quality.section_shape_sigma_mm);
  EXPECT_GT(std::sqrt(beyond / num_beyond), 1.2 * inside);
}

TEST(CrossValidation, DiffersByAboutItsPredictionWhereTheModelIsTrue) {
  // Difference and prediction are rms over a section whose error has a few dominant directions: single ratios
  // scatter by about a half, their quadratic mean over six rigs by a quarter.
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto result = calibrated(plain_rig(2, seed), {.poses = 14, .seed = seed});
    ASSERT_TRUE(result.diagnosis->cross_validation.done) << result.diagnosis->cross_validation.why_not;
    sum += std::pow(result.rig.quality.cross_validation_ratio.value(), 2) / 6;
  }
  EXPECT_GT(std::sqrt(sum), 0.5);
  EXPECT_LT(std::sqrt(sum), 1.6);
}

TEST(CrossValidation, FindsALensModelThatIsTooLean) {
  auto truth = plain_rig(2, 3);
  for (auto& sensor : truth.sensors) sensor.camera.distortion[0] = -0.25;
  CalibrationOptions options;
  options.lens = LensModel::kPinhole;
  options.board_warp = false;
  const auto result =
      calibrate_rig(observe(truth, {.corner_noise_px = 0.03, .stripe_noise_px = 0.03}), options);
  ASSERT_TRUE(result.diagnosis) << result.summary.message;
  EXPECT_GT(result.rig.quality.cross_validation_ratio.value_or(0), 2);
  EXPECT_THAT(result.rig.quality.warnings, ::testing::Contains(HasSubstr("a lens model too lean")));
}

TEST(CrossValidation, SaysWhyItWasNotDone) {
  const auto result = calibrated(plain_rig(1, 0), {.poses = 8});
  EXPECT_FALSE(result.diagnosis->cross_validation.done);
  EXPECT_THAT(result.diagnosis->cross_validation.why_not, HasSubstr("fewer than 10 views"));
}

TEST(WeakestDirection, OfHardlyTiltedBoardsIsTheRangeAndTheyAreNamed) {
  const auto result = calibrated(plain_rig(1, 0), {.max_tilt_deg = 6});
  EXPECT_THAT(result.diagnosis->weakest, HasSubstr("range: all points together nearer or farther by"));
  EXPECT_THAT(result.diagnosis->weakest, HasSubstr("tilt them by 20 to 45"));
}

TEST(ResidualSamples, ListOutliersToo) {
  const auto truth = plain_rig(1, 1);
  auto observations = observe(truth, {});
  observations.sensors[0].views[3].corners[17].x() += 2;
  const auto result = calibrate_rig(observations, brown4());
  ASSERT_TRUE(result.diagnosis) << result.summary.message;
  int outliers = 0;
  for (const auto& sample : result.diagnosis->residuals) {
    if (sample.used) continue;
    ++outliers;
    if (sample.corner && sample.normalised > 20) {
      EXPECT_EQ(result.summary.views[static_cast<std::size_t>(sample.view)].image, "gauge_3");
      EXPECT_EQ(sample.pixel, observations.sensors[0].views[3].corners[17]);
      EXPECT_NEAR(std::abs(sample.residual_px.x()), 2, 0.3);
    }
  }
  EXPECT_GE(outliers, 1);
  EXPECT_LE(outliers, 6);  // 4.5 sigma in two dimensions: 1 of 25000 by chance
}

}  // namespace
}  // namespace lightstripe
