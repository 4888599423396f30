// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A rig checked on boards with known errors put into it.
#include "calib/verify/verify_rig.h"

#include <gtest/gtest.h>

#include "calib/adjust/rig_frame.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using testing::observe;
using testing::rail_rig;

const testing::SessionOptions kPerfect{.poses = 8, .corner_noise_px = 0, .stripe_noise_px = 0};

Rig rig_of(const testing::SyntheticRig& truth) {
  Rig rig;
  const Rigid3 rig_from_first{rig_rotation(truth.direction, {0, -1, 0}), Eigen::Vector3d::Zero()};
  for (std::size_t s = 0; s < truth.sensors.size(); ++s)
    rig.sensors.push_back({s == 0 ? "gauge" : "field", truth.sensors[s].camera, truth.sensors[s].laser_planes,
                           rig_from_first * truth.sensors[s].cam_from_first.inverse()});
  rig.motion.type = MotionType::kLinear;
  return rig;
}

TEST(VerifyRig, FindsNoErrorInTheTrueRig) {
  const auto truth = rail_rig(2, 1);
  const auto result = verify_rig(observe(truth, kPerfect), rig_of(truth));
  EXPECT_EQ(result.views.size(), 16u);
  EXPECT_EQ(result.pairs.size(), 8u);
  for (const auto& view : result.views) {
    EXPECT_LT(view.corner_rms_px, 1e-3) << view.image;
    if (view.stripe_points == 0) continue;  // the laser misses the board
    EXPECT_LT(view.plane_max_mm, 2e-3);
    EXPECT_NEAR(view.length_error_mm, 0, 0.02);  // the map of the board from its corners is no exact lens
    EXPECT_GT(view.length_mm, 40);
  }
  EXPECT_GT(by_sensor(result)[0].views + by_sensor(result)[1].views, 12);
  for (const auto& pair : result.pairs) {
    if (pair.gap_mm) {
      EXPECT_NEAR(*pair.gap_mm, 0, 2e-3);
    }
    EXPECT_LT(pair.centre_gap_mm, 2e-3);
  }
  ASSERT_TRUE(result.travel_rms_mm);
  EXPECT_LT(*result.travel_rms_mm, 2e-3);
}

TEST(VerifyRig, SeesALaserPlaneThatHasShifted) {
  // The laser plane stands at (40 + slant) degrees to the line of sight: a shift by 0.3 mm along its normal
  // moves the points by 0.3 / sin(angle of ray and plane) along the ray, some 0.4 mm.
  const auto truth = rail_rig(1, 1);
  auto rig = rig_of(truth);
  rig.sensors[0].laser_planes[0].offset += 0.3;
  const auto result = verify_rig(observe(truth, kPerfect), rig);
  const auto summary = by_sensor(result);
  ASSERT_EQ(summary.size(), 1u);
  EXPECT_GT(summary[0].plane_rms_mm, 0.25);
  EXPECT_LT(summary[0].plane_rms_mm, 0.6);
  VerifyLimits limits;
  limits.max_plane_rms_mm = 0.2;
  ASSERT_EQ(exceeded(result, limits).size(), 1u);
  EXPECT_NE(exceeded(result, limits)[0].find("gauge: stripe off the board's plane"), std::string::npos);
  limits.max_plane_rms_mm = 1;
  EXPECT_TRUE(exceeded(result, limits).empty());
}

TEST(VerifyRig, SeesASensorThatWasKnockedAsAGap) {
  // 0.5 mm of the field sensor's place along the mean normal of the boards opens a gap of about that size.
  const auto truth = rail_rig(2, 1);
  auto rig = rig_of(truth);
  rig.sensors[1].rig_from_camera.translation +=
      0.5 * (rig.sensors[0].rig_from_camera.rotation * Eigen::Vector3d::UnitZ());
  const auto seams = by_seam(verify_rig(observe(truth, kPerfect), rig));
  ASSERT_EQ(seams.size(), 1u);
  EXPECT_NEAR(seams[0].centre_gap_mm, 0.5, 0.01);
  EXPECT_GT(seams[0].gap_mm, 0.25);
  EXPECT_LT(seams[0].gap_mm, 0.51);
}

TEST(VerifyRig, SeesALengthThatIsWrongByAThousandth) {
  // On a board whose pitch is given 0.1 % too small the rig's lengths seem 0.1 % too long.
  const auto truth = rail_rig(1, 1);
  auto observations = observe(truth, kPerfect);
  observations.target.pitch_x *= 0.999;
  observations.target.pitch_y *= 0.999;
  const auto result = verify_rig(observations, rig_of(truth));
  for (const auto& view : result.views) {
    if (view.length_mm > 0) {
      EXPECT_NEAR(view.length_error_mm / view.length_mm, 1e-3, 3e-4) << view.image;
    }
  }
}

TEST(VerifyRig, SeesATravelScaleThatIsWrong) {
  // 60 mm of travel in 6 steps with a scale 1 % too long: the middles spread over 0.6 mm, 0.205 mm rms.
  const auto truth = rail_rig(1, 1);
  auto observations = observe(truth, kPerfect);
  for (auto& travel : observations.motion->travel) travel *= 1.01;
  const auto result = verify_rig(observations, rig_of(truth));
  ASSERT_TRUE(result.travel_rms_mm);
  EXPECT_NEAR(*result.travel_rms_mm, 0.6 * std::sqrt(35.0 / 300.0), 0.005);
}

}  // namespace
}  // namespace lightstripe
