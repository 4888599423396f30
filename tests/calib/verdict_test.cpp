// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/assess/verdict.h"

#include <gmock/gmock.h>

namespace lightstripe {
namespace {

using ::testing::HasSubstr;

/// One sensor whose boards and stripes are as good as they should be.
class Verdict : public ::testing::Test {
 protected:
  Verdict() {
    session.sensor_names = {"gauge"};
    session.given_cameras.resize(1);
    session.motion = MotionType::kLinear;
    adjustment.converged = true;
    adjustment.covariance = Eigen::MatrixXd::Identity(3, 3);
    adjustment.lenses = {LensModel::kBrown4};
    adjustment.state.sensors.push_back({Camera{960, 700, 1600, 1600, 480, 350, {}}, {}, {}});
    adjustment.state.first_from_board = {{Eigen::Quaterniond::Identity(), {0, 0, 500}}};
    spreads[0].tilt_deg = 30, spreads[0].laser_angles_deg = {{40, 50, 60}};
    spreads[0].stripe_depths = {450, 550}, spreads[0].stripe_coverage = 0.7;
    quality[0].name = "gauge", quality[0].board_rms_px = 0.1, quality[0].stripe_rms_px = 0.1;
  }
  template <class F>
  static std::string refusal(const F& check) {
    try {
      check();
    } catch (const NotUsable& error) {
      return error.what();
    }
    return "";
  }
  std::string refuse() const {
    return refusal([&] { refuse_bad_adjustment(session, adjustment, quality, spreads); });
  }
  std::string extrapolation() const {
    return refusal([&] { refuse_extrapolation(session, spreads, options); });
  }

  SessionViews session;
  JointAdjustment adjustment;
  std::vector<BoardSpread> spreads = std::vector<BoardSpread>(1);
  std::vector<SensorQuality> quality = std::vector<SensorQuality>(1);
  CalibrationOptions options;
};

TEST_F(Verdict, AGoodOnePasses) {
  EXPECT_EQ(refuse(), "");
  EXPECT_EQ(extrapolation(), "");
  EXPECT_TRUE(warnings_about(session, adjustment, {}, spreads).empty());
}

TEST_F(Verdict, EachFaultIsNamedBeyondItsLimit) {
  quality[0].board_rms_px = 2.1;
  EXPECT_THAT(refuse(), HasSubstr("sensor gauge: the corners miss the board by 2.1 px"));
  quality[0].board_rms_px = 1.9, quality[0].stripe_rms_px = 2.1;
  EXPECT_THAT(refuse(), HasSubstr("the stripes miss the laser plane by 2.1 px"));
  quality[0].stripe_rms_px = 1.9, spreads[0].tilt_deg = 4.9;
  EXPECT_THAT(refuse(), HasSubstr("tilted by 4.9 degrees at most"));
  session.given_cameras[0] = GivenCamera{};  // fixed: needs no tilt
  EXPECT_EQ(refuse(), "");
  adjustment.covariance.resize(0, 0);
  EXPECT_THAT(refuse(), HasSubstr("leave a direction of the rig open"));
  adjustment.converged = false;
  EXPECT_THAT(refuse(), HasSubstr("did not converge"));
}

TEST_F(Verdict, TheSectionsShapeIsKnownToAShareOfTheRange) {
  EXPECT_EQ(refusal([&] { refuse_uncertain_section(adjustment, 0.24); }), "");  // 5e-4 of 500 mm
  EXPECT_THAT(refusal([&] { refuse_uncertain_section(adjustment, 0.26); }),
              HasSubstr("uncertain by 0.26 mm"));
}

TEST_F(Verdict, HalfOfTheBoardsBesideTheLaserPlaneAreTooMany) {
  const auto parallel = [&] { return refusal([&] { refuse_parallel_lasers(session, spreads); }); };
  spreads[0].laser_angles_deg = {{9, 11, 50}};
  EXPECT_EQ(parallel(), "");
  spreads[0].laser_angles_deg = {{9, 9.5, 50}};
  EXPECT_THAT(parallel(), HasSubstr("nearly parallel to the laser plane (9.5 degrees"));
}

TEST_F(Verdict, StripesCoverTheImageAndTheDeclaredRange) {
  options.range_near_mm = 400, options.range_far_mm = 560;  // 100 of 160 mm are seen
  EXPECT_EQ(extrapolation(), "");
  options.range_far_mm = 580;
  EXPECT_THAT(extrapolation(),
              HasSubstr("between 450 and 550 mm of depth, the measuring range is 400 to 580 mm"));
  options.range_near_mm = options.range_far_mm = 0, spreads[0].stripe_coverage = 0.11;
  EXPECT_THAT(extrapolation(), HasSubstr("cover 11 % of the image's diagonal"));
}

TEST_F(Verdict, PixelsAreSquare) {
  adjustment.state.sensors[0].camera.fy = 1600 / 1.05;
  const auto oblong = [&] { return refusal([&] { refuse_oblong_pixels(session, adjustment.state); }); };
  EXPECT_THAT(oblong(), HasSubstr("1.05 times as high as wide"));
  adjustment.state.sensors[0].camera.fy = 1600 / 1.03;
  EXPECT_EQ(oblong(), "");
}

TEST_F(Verdict, WeakSpotsAreWarnings) {
  ViewResidual view;
  view.image = "7.png", view.corners = 70, view.stripe_points = 9, view.left_out = 21;
  spreads[0].tilt_deg = 14, spreads[0].stripe_coverage = 0.39;
  adjustment.state.board_warp_mm = {0.06, -0.01};
  session.motion = MotionType::kNone;
  const auto warnings = warnings_about(session, adjustment, {view}, spreads);
  ASSERT_EQ(warnings.size(), 5U);
  EXPECT_THAT(warnings[0], HasSubstr("7.png: 21 of 100 measurements"));
  EXPECT_THAT(warnings[1], HasSubstr("tilted by 14 degrees"));
  EXPECT_THAT(warnings[2], HasSubstr("cover 39 %"));
  EXPECT_THAT(warnings[3], HasSubstr("bowed by 0.06 mm along x"));
  EXPECT_THAT(warnings[4], HasSubstr("no motion was calibrated"));
}

TEST(CrossValidationWarning, FromTwiceThePredictionOn) {
  CrossValidation halves;
  halves.done = true, halves.predicted_mm = 0.01, halves.difference_mm = 0.019;
  EXPECT_TRUE(warnings_about(halves).empty());
  halves.difference_mm = 0.021;
  EXPECT_THAT(warnings_about(halves).front(), HasSubstr("differ by 0.0210 mm, 2.1 times"));
}

}  // namespace
}  // namespace lightstripe
