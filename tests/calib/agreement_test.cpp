// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Units, sensors that contradict each other, cross-validation that was not made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/calibrate_rig.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

CalibrationObservations session(int travel_steps = 0, int poses = 12) {
  testing::SessionOptions options;
  options.poses = poses;
  options.travel_steps = travel_steps;
  return testing::observe(testing::rail_rig(2, 4), options);
}

CalibrationResult calibrated(const CalibrationObservations& observations, CalibrationOptions options = {}) {
  options.lens = LensModel::kBrown4;
  return calibrate_rig(observations, options);
}

TEST(Agreement, SquaresInAnotherUnitAreRefused) {
  for (const auto& [factor, unit] : {std::pair{1e-3, "did you give metres?"},
                                     {0.1, "did you give centimetres?"},
                                     {1e3, "mm from the camera"}}) {
    auto observations = session();
    observations.target.pitch_x *= factor;
    observations.target.pitch_y *= factor;
    const auto result = calibrated(observations);
    EXPECT_FALSE(result.summary.usable) << factor;
    EXPECT_THAT(result.summary.message, HasSubstr(unit));
  }
}

TEST(Agreement, ADeclaredRangeVouchesForASmallRig) {
  auto observations = session();
  observations.target.pitch_x *= 0.1;
  observations.target.pitch_y *= 0.1;
  CalibrationOptions options;
  options.range_near_mm = 51;
  options.range_far_mm = 59;
  const auto result = calibrated(observations, options);
  EXPECT_TRUE(result.summary.usable) << result.summary.message;
}

TEST(Agreement, TravelThatContradictsTheSquaresIsRefused) {
  auto observations = session(6);
  observations.target.pitch_x *= 1.1;
  observations.target.pitch_y *= 1.1;
  EXPECT_THAT(calibrated(observations).summary.message, HasSubstr("mm in the camera for each mm of travel"));
}

TEST(Agreement, SensorsThatSeeOtherPosesAreRefused) {
  auto observations = session();
  auto& views = observations.sensors[1].views;
  const auto before = views;
  for (std::size_t i = 0; i < views.size(); ++i) views[i].pose = before[(i + 1) % views.size()].pose;
  EXPECT_THAT(calibrated(observations).summary.message, HasSubstr("the sensors contradict each other in"));
}

TEST(Agreement, AnEmptyRatioMeansThatNoHalvesWereCompared) {
  const auto few = calibrated(session(0, 9));
  ASSERT_TRUE(few.summary.usable) << few.summary.message;
  EXPECT_FALSE(few.rig.quality.cross_validation_ratio);
  EXPECT_THAT(few.diagnosis->cross_validation.why_not, HasSubstr("fewer than 10 views"));
  const auto many = calibrated(session(0, 12));
  EXPECT_TRUE(many.rig.quality.cross_validation_ratio);
}

}  // namespace
}  // namespace lightstripe
