// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Predicted against actual errors where stripes say their own noise badly: in grainy light a stripe of few
// points does.
#include "calib/adjust/joint_adjustment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/adjust/session_views.h"
#include "calib/assess/uncertainty.h"
#include "calib/start/initial_values.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

constexpr double kNoisePx = 0.4;

/// Each stripe's sigma as one degree of freedom tells it; the points' true noise is one and the same.
CalibrationObservations observations(const testing::SyntheticRig& truth, std::uint64_t seed) {
  auto seen = testing::observe(
      truth,
      {.poses = 14, .stripe_noise_px = kNoisePx, .stripe_width_px = 90, .travel_steps = 0, .seed = seed});
  Random random(seed, 5);
  for (auto& view : seen.sensors[0].views) {
    double squares = 0;
    for (int i = 0; i < 1; ++i) squares += std::pow(random.gaussian(), 2) / 1;
    for (auto& point : view.stripes[0]) point.sigma_px = kNoisePx * std::sqrt(squares);
  }
  return seen;
}

TEST(JointAdjustment, AStripeThatSeemsExactByChanceDoesNotDecide) {
  CalibrationOptions options;
  options.board_warp = false;
  double turns = 0, predicted = 0;
  constexpr int kTrials = 120;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    auto truth = testing::rail_rig(1, 500 + seed);
    truth.sensors[0].camera.distortion[4] = 0;
    const InitialValues start = initial_values(prepare_session_views(observations(truth, 500 + seed)));
    const auto adjusted = adjust_jointly(start.session, start.state, {LensModel::kBrown4}, options);
    ASSERT_TRUE(adjusted.converged);
    const auto& found = adjusted.state.sensors[0].laser_planes[0].normal;
    turns += std::pow(std::asin(found.cross(truth.sensors[0].laser_planes[0].normal).norm()) / kDegree, 2);
    predicted += std::pow(parameter_sigmas(start.session, adjusted).at("gauge.laser_planes.0.normal_deg"), 2);
  }
  const double ratio =
      std::sqrt(turns / predicted);  // of 120 trials: 4 % uncertain; 1.2 with each stripe by its own sigma
  EXPECT_LT(ratio, 1.1);
  EXPECT_GT(ratio, 0.8);
  std::printf("actual over predicted turn of the laser plane: %.2f\n", ratio);
}

}  // namespace
}  // namespace lightstripe
