// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Laser pictures of other poses, pictures turned or mirrored, pictures given twice.
#include "calib/start/pairing_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/calibrate_rig.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

CalibrationObservations session(int poses = 14) {
  testing::SessionOptions options;
  options.poses = poses;
  options.travel_steps = 0;
  auto observations = testing::observe(testing::rail_rig(1, 3), options);
  for (auto& view : observations.sensors[0].views) view.laser_apart = true;
  return observations;
}

CalibrationResult calibrated(const CalibrationObservations& observations) {
  CalibrationOptions options;
  options.lens = LensModel::kBrown5;
  return calibrate_rig(observations, options);
}

/// The stripe of view i goes to view i + by.
CalibrationObservations with_lasers_shifted(int by) {
  auto observations = session();
  auto& views = observations.sensors[0].views;
  const auto before = views;
  const int n = static_cast<int>(views.size());
  for (int i = 0; i < n; ++i)
    views[static_cast<std::size_t>(i)].stripes = before[static_cast<std::size_t>((i - by + n) % n)].stripes;
  return observations;
}

TEST(PairingFaults, AGoodSessionAgrees) {
  const auto result = calibrated(session());
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  ASSERT_EQ(result.summary.stripes.size(), 1U);
  EXPECT_EQ(result.summary.stripes[0].found, result.summary.stripes[0].agreeing);
}

TEST(PairingFaults, FilesShiftedByOneAreRefusedAndNamed) {
  const auto result = calibrated(with_lasers_shifted(-1));
  EXPECT_FALSE(result.summary.usable);
  EXPECT_THAT(result.summary.message, HasSubstr("stripes lie in one plane"));
  EXPECT_THAT(result.summary.message,
              HasSubstr("the laser picture of gauge_1 fits the board of gauge_2, and so on: are the files "
                        "shifted by one?"));
}

TEST(PairingFaults, ReversedOrderIsRefused) {
  auto observations = session();
  auto& views = observations.sensors[0].views;
  const auto before = views;
  for (std::size_t i = 0; i < views.size(); ++i) views[i].stripes = before[views.size() - 1 - i].stripes;
  const auto result = calibrated(observations);
  EXPECT_FALSE(result.summary.usable);
  EXPECT_THAT(result.summary.message, HasSubstr("stripes lie in one plane"));
}

TEST(PairingFaults, TwoWrongPairsOfFourteenAreLeftOutAndNamed) {
  auto observations = session();
  std::swap(observations.sensors[0].views[4].stripes, observations.sensors[0].views[5].stripes);
  const auto result = calibrated(observations);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_THAT(result.rig.quality.warnings,
              Contains(::testing::AllOf(HasSubstr("gauge_4: stripe left out"),
                                        HasSubstr("fits the board of gauge_5"))));
  EXPECT_THAT(result.rig.quality.warnings, Contains(HasSubstr("gauge_5: stripe left out")));
}

void turn_around(BoardView& view, bool x, bool y) {
  const auto move = [&](double& px, double& py) {
    if (x) px = 959 - px;
    if (y) py = 699 - py;
  };
  for (auto& corner : view.corners) move(corner.x(), corner.y());
  for (auto& point : view.stripes[0]) move(point.x, point.y);
  if (x != y)
    for (auto row = view.corners.begin(); row != view.corners.end(); row += 11) std::reverse(row, row + 11);
}

TEST(PairingFaults, PicturesTurnedOrMirroredAreRefusedByName) {
  for (const bool mirrored : {false, true}) {
    auto observations = session();
    for (std::size_t i = 0; i < 5; ++i) turn_around(observations.sensors[0].views[2 * i], !mirrored, true);
    const auto result = calibrated(observations);
    EXPECT_FALSE(result.summary.usable);
    EXPECT_THAT(result.summary.message,
                HasSubstr("of 13 pictures look"));  // this laser looks nearly the same both ways
  }
}

TEST(PairingFaults, APictureGivenTwiceCountsOnce) {
  auto observations = session(10);
  auto& views = observations.sensors[0].views;
  views[6].corners = views[2].corners;
  views[6].stripes = views[2].stripes;
  views[7].stripes = views[3].stripes;
  const auto result = calibrated(observations);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_THAT(result.rig.quality.warnings, Contains("gauge_6: left out, it is the same picture as gauge_2"));
  EXPECT_THAT(result.rig.quality.warnings,
              Contains("gauge_7: stripe left out, its laser picture is the same as that of gauge_3"));
}

TEST(PairingFaults, NoStripeAnywhereIsNoLaser) {
  auto observations = session();
  for (auto& view : observations.sensors[0].views) view.stripes[0].clear();
  EXPECT_THAT(calibrated(observations).summary.message, HasSubstr("no laser line on any board"));
}

}  // namespace
}  // namespace lightstripe
