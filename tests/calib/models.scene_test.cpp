// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the joint adjustment knows beyond a flat board before a plain lens: tilted sensors, richer lenses,
// bowed boards, partial views, cameras that are given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/calibrate_rig.h"
#include "core/random.h"
#include "section_error.h"

namespace lightstripe {
namespace {

using testing::observe;
using testing::rail_rig;
using testing::section_error;
using testing::SessionOptions;
using testing::state_of;

CalibrationOptions with_lens(LensModel lens) {
  CalibrationOptions options;
  options.lens = lens;
  options.board_warp = true;
  return options;
}

/// A rail rig with the distortion given, in OpenCV's order.
testing::SyntheticRig rig_with(const std::array<double, kDistortionTerms>& distortion, int sensors = 2) {
  auto rig = rail_rig(sensors, 4);
  for (auto& sensor : rig.sensors) sensor.camera.distortion = distortion;
  return rig;
}

const std::array<double, kDistortionTerms> kScheimpflug{-0.09, 0.12, 0, 0, 0, 0,           0,
                                                        0,     0,    0, 0, 0, 8 * kDegree, 0.5 * kDegree};

TEST(LensModels, EachReturnsItsOwnTruthWithoutNoise) {
  const SessionOptions perfect{.poses = 14, .corner_noise_px = 0, .stripe_noise_px = 0};
  const std::vector<std::pair<LensModel, std::array<double, kDistortionTerms>>> cases{
      {LensModel::kPinhole, {}},
      {LensModel::kBrown4, {-0.1, 0.1, 4e-4, -3e-4}},
      {LensModel::kRational, {0.3, 0.1, 4e-4, -3e-4, 0.02, 0.4, 0.1, 0.1}},
      {LensModel::kThinPrism, {-0.3, 0.1, 4e-4, -3e-4, 0.02, 0.1, 0.1, 0.1, 2e-3, -1e-2, 1e-3, 2e-2}},
      {LensModel::kTilted, kScheimpflug}};
  for (const auto& [lens, distortion] : cases) {
    const auto truth = rig_with(distortion, 1);
    const auto observations = observe(truth, perfect);
    const auto result = calibrate_rig(observations, with_lens(lens));
    ASSERT_TRUE(result.summary.usable) << enum_name(lens) << ": " << result.summary.message;
    EXPECT_LT(section_error(state_of(result.rig), truth, observations).absolute_mm, 1e-4) << enum_name(lens);
    EXPECT_LT(result.rig.quality.sensors[0].board_rms_px, 1e-5) << enum_name(lens);
  }
}

TEST(LensModels, TangentialTermsStayZeroWhereTheTiltIsFree) {
  const auto result = calibrate_rig(observe(rig_with(kScheimpflug)), with_lens(LensModel::kTilted));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_EQ(result.rig.sensors[0].camera.distortion[2], 0);
  EXPECT_EQ(result.rig.sensors[0].camera.distortion[3], 0);
  EXPECT_EQ(result.rig.quality.sigma.count("gauge.camera.p1"), 0u);
  EXPECT_EQ(result.rig.quality.sigma.count("gauge.camera.tau_x"), 1u);
}

TEST(LensModels, AutomaticChoiceFindsTheTiltedSensor) {
  // Tilted about a diagonal: pixels become oblique, which no other model has. (About x or y alone brown4 is
  // as good, and may be chosen.)
  auto distortion = kScheimpflug;
  distortion[12] = distortion[13] = 5.6 * kDegree;
  const auto result = calibrate_rig(observe(rig_with(distortion)), with_lens(LensModel::kAuto));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  ASSERT_EQ(result.summary.lenses.size(), 2u);
  for (const auto& choice : result.summary.lenses)
    EXPECT_EQ(choice.lens, LensModel::kTilted) << choice.sensor << " " << choice.trials[0].held_out_rms_px
                                               << " " << choice.trials[1].held_out_rms_px;
}

TEST(LensModels, AutomaticChoiceIsTheLeanestOfEqualOnes) {
  const auto result = calibrate_rig(observe(rig_with({-0.1, 0.1, 4e-4, -3e-4})), with_lens(LensModel::kAuto));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  for (const auto& choice : result.summary.lenses) {
    EXPECT_EQ(choice.lens, LensModel::kBrown4);
    EXPECT_GE(choice.trials.size(), 2u);
  }
}

TEST(LensModels, AutomaticChoiceIsNotDrownedByCornersUnderTheLaser) {
  // Where one picture shows board and laser, the corners under the line are pixels off: 8 of 88 here.
  // Held-out corners of 0.07 px per coordinate leave 0.1 px, and a little for the poses fitted to them.
  auto session = observe(rig_with({-0.1, 0.1, 4e-4, -3e-4}, 1));
  Random random(5);
  for (auto& view : session.sensors[0].views)
    for (std::size_t c = 0; c < view.corners.size(); c += 11)
      view.corners[c] += Eigen::Vector2d(random.uniform(-6, 6), random.uniform(-6, 6));
  const auto result = calibrate_rig(session, with_lens(LensModel::kAuto));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  const auto& choice = result.summary.lenses[0];
  EXPECT_EQ(choice.lens, LensModel::kBrown4);
  ASSERT_FALSE(choice.trials.empty());
  EXPECT_LT(choice.trials[0].held_out_rms_px, 0.12);
}

TEST(LensModels, AutomaticChoiceTakesTheRationalTermsThatAWideLensNeeds) {
  // A pincushion 1 / (1 - r^2 / 2), whose polynomial does not end, over 69 degrees: brown5 leaves clearly
  // more.
  auto truth = rig_with({0, 0, 0, 0, 0, -0.5}, 1);
  for (auto& sensor : truth.sensors) sensor.camera.fx = sensor.camera.fy = 700;
  truth.target.pitch_x = truth.target.pitch_y = 50;
  const auto session =
      observe(truth, {.poses = 30, .max_tilt_deg = 40, .corner_noise_px = 0.02, .stripe_noise_px = 0.02});
  const auto chosen = calibrate_rig(session, with_lens(LensModel::kAuto));
  ASSERT_TRUE(chosen.summary.usable) << chosen.summary.message;
  const auto lens = chosen.summary.lenses[0].lens;
  EXPECT_TRUE(lens == LensModel::kRational || lens == LensModel::kTiltedRational) << enum_name(lens);
  EXPECT_LT(chosen.rig.quality.sensors[0].board_rms_px, 0.0292);  // the noise: 0.02 sqrt 2 = 0.0283
}

TEST(LensModels, AScheimpflugSensorIsAsGoodAsAnUprightOne) {
  // Predicted shape errors of the same views, and the actual one within four times its prediction (rms of a
  // few tens of dependent directions).
  const auto upright = rig_with({-0.09, 0.12}), tilted = rig_with(kScheimpflug);
  const auto a = calibrate_rig(observe(upright), with_lens(LensModel::kBrown4));
  const auto seen = observe(tilted);
  const auto b = calibrate_rig(seen, with_lens(LensModel::kTilted));
  ASSERT_TRUE(a.summary.usable && b.summary.usable) << a.summary.message << b.summary.message;
  EXPECT_LT(b.rig.quality.section_shape_sigma_mm, 1.15 * a.rig.quality.section_shape_sigma_mm);
  EXPECT_LT(section_error(state_of(b.rig), tilted, seen).shape_mm, 4 * b.rig.quality.section_shape_sigma_mm);
}

TEST(BoardWarp, IsFoundAsItIs) {
  const auto truth = rail_rig(2, 1);
  SessionOptions options{.poses = 12, .corner_noise_px = 0, .stripe_noise_px = 0};
  options.board_warp_mm = {0.1, -0.05};
  const auto observations = observe(truth, options);
  const auto result = calibrate_rig(observations, with_lens(LensModel::kBrown5));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_NEAR(result.summary.board_warp_mm.x(), 0.1, 1e-5);
  EXPECT_NEAR(result.summary.board_warp_mm.y(), -0.05, 1e-5);
  EXPECT_LT(section_error(state_of(result.rig), truth, observations).absolute_mm, 1e-3);
}

TEST(BoardWarp, ABowOfATenthChangesTheResultByLessThanItsSigma) {
  // The same noise on a flat board and on a bowed one; each parameter may move by its own sigma at most.
  const auto truth = rail_rig(2, 2);
  SessionOptions flat{.seed = 2}, bowed{.seed = 2};
  bowed.board_warp_mm = {0.1, 0};
  const auto a = calibrate_rig(observe(truth, flat), with_lens(LensModel::kBrown5));
  const auto b = calibrate_rig(observe(truth, bowed), with_lens(LensModel::kBrown5));
  ASSERT_TRUE(a.summary.usable && b.summary.usable) << a.summary.message << b.summary.message;
  const auto& sigma = a.rig.quality.sigma;
  for (std::size_t s = 0; s < 2; ++s) {
    const auto &p = a.rig.sensors[s], &q = b.rig.sensors[s];
    EXPECT_LT(std::abs(p.camera.fx - q.camera.fx), sigma.at(p.name + ".camera.fx"));
    EXPECT_LT(std::abs(p.laser_planes[0].offset - q.laser_planes[0].offset),
              sigma.at(p.name + ".laser_planes.0.offset_mm"));
  }
  const auto seen = observe(truth, flat);
  const auto at = [&](const Rig& rig) { return section_error(state_of(rig), truth, seen).shape_mm; };
  EXPECT_LT(std::abs(at(a.rig) - at(b.rig)), a.rig.quality.section_shape_sigma_mm);
}

TEST(BoardWarp, LeftOutOfTheModelItSpoilsTheShape) {
  const auto truth = rail_rig(2, 2);
  SessionOptions bowed{.seed = 2};
  bowed.board_warp_mm = {0.3, 0};
  const auto observations = observe(truth, bowed);
  auto flat_model = with_lens(LensModel::kBrown5);
  flat_model.board_warp = false;
  const auto without = calibrate_rig(observations, flat_model);
  const auto with = calibrate_rig(observations, with_lens(LensModel::kBrown5));
  ASSERT_TRUE(with.summary.usable) << with.summary.message;
  if (!without.summary.usable) return;
  EXPECT_GT(section_error(state_of(without.rig), truth, observations).shape_mm,
            2 * section_error(state_of(with.rig), truth, observations).shape_mm);
}

TEST(PartialViews, CountWithTheCornersThatTheyShow) {
  const auto truth = rail_rig(2, 3);
  auto observations = observe(truth, {.poses = 12, .corner_noise_px = 0, .stripe_noise_px = 0});
  for (auto& sensor : observations.sensors)
    for (std::size_t v = 0; v < sensor.views.size(); v += 2)
      for (std::size_t i = 0; i < 40; ++i) sensor.views[v].corners[(i + 7 * v) % 88] = unseen_corner();
  const auto result = calibrate_rig(observations, with_lens(LensModel::kBrown5));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_LT(section_error(state_of(result.rig), truth, observations).absolute_mm, 1e-4);
  EXPECT_EQ(result.summary.views[0].corners, 48);
  EXPECT_EQ(result.summary.views[1].corners, 88);
}

TEST(GivenCamera, StaysFixedToTheLastBit) {
  const auto truth = rail_rig(2, 3);
  auto observations = observe(truth, {.poses = 6});
  observations.sensors[0].given_camera = GivenCamera{truth.sensors[0].camera, true};
  const auto result = calibrate_rig(observations, with_lens(LensModel::kAuto));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_EQ(result.rig.sensors[0].camera.fx, truth.sensors[0].camera.fx);
  EXPECT_EQ(result.rig.sensors[0].camera.distortion, truth.sensors[0].camera.distortion);
  EXPECT_EQ(result.rig.quality.sigma.count("gauge.camera.fx"), 0u);
  EXPECT_EQ(result.rig.quality.sigma.count("field.camera.fx"), 1u);
}

TEST(GivenCamera, AsAStartMovesToTheTruth) {
  const auto truth = rail_rig(1, 3);
  auto observations = observe(truth, {.poses = 10, .corner_noise_px = 0, .stripe_noise_px = 0});
  Camera rough = truth.sensors[0].camera;
  rough.fx *= 1.03;
  rough.fy *= 1.03;
  rough.cx += 10;
  observations.sensors[0].given_camera = GivenCamera{rough, false};
  const auto result = calibrate_rig(observations, with_lens(LensModel::kBrown5));
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_NEAR(result.rig.sensors[0].camera.fx, truth.sensors[0].camera.fx, 1e-4);
}

TEST(GivenCamera, OfAnotherLensOrModelIsRefused) {
  const auto truth = rail_rig(1, 3);
  auto observations = observe(truth, {.poses = 8});
  // Four coefficients of a fisheye model, as small as a poor lens has them, under the name of k1 k2 p1 p2.
  Camera fisheye = truth.sensors[0].camera;
  fisheye.distortion = {-0.04, 0.06, -0.02, 0.012};
  observations.sensors[0].given_camera = GivenCamera{fisheye, true};
  const auto refused = calibrate_rig(observations, with_lens(LensModel::kAuto));
  EXPECT_FALSE(refused.summary.usable) << refused.rig.quality.sensors[0].board_rms_px;
  EXPECT_THAT(refused.summary.message, ::testing::HasSubstr("the given camera did not take these pictures"));
  EXPECT_THAT(refused.summary.message, ::testing::HasSubstr("no fisheye"));
}

}  // namespace
}  // namespace lightstripe
