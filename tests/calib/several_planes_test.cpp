// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sensors that see several laser planes: parallel sheets, crossing ones, stripes listed in any order.
#include <gtest/gtest.h>

#include <algorithm>

#include "calib/calibrate_rig.h"
#include "section_error.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using testing::observe;

const testing::SessionOptions kPerfect{.poses = 12, .corner_noise_px = 0, .stripe_noise_px = 0};

CalibrationOptions brown5() {
  CalibrationOptions options;
  options.lens = LensModel::kBrown5;
  options.board_warp = true;
  return options;
}

/// A one-sensor rig whose sheet comes again turned by these angles about the line of sight and shifted by
/// these distances.
testing::SyntheticRig rig_with_planes(const std::vector<std::pair<double, double>>& turn_deg_and_shift_mm) {
  auto rig = testing::rail_rig(1, 2);
  const Plane first = rig.sensors[0].laser_planes[0];
  rig.sensors[0].laser_planes.clear();
  const Vector3d centre(0, 0, rig.range_mm);
  for (const auto& [turn, shift] : turn_deg_and_shift_mm) {
    const Vector3d normal = Eigen::AngleAxisd(turn * kDegree, Vector3d::UnitZ()) * first.normal;
    rig.sensors[0].laser_planes.push_back({normal, normal.dot(centre) + shift});
  }
  return rig;
}

void expect_planes(const Rig& rig, const testing::SyntheticRig& truth) {
  const auto& found = rig.sensors[0].laser_planes;
  ASSERT_EQ(found.size(), truth.sensors[0].laser_planes.size());
  for (const Plane& known : truth.sensors[0].laser_planes) {
    const bool there = std::any_of(found.begin(), found.end(), [&](const Plane& plane) {
      return (plane.normal - known.normal).norm() < 1e-5 && std::abs(plane.offset - known.offset) < 1e-3;
    });
    EXPECT_TRUE(there) << known.normal.transpose() << ", " << known.offset;
  }
}

TEST(SeveralPlanes, FiveSheetsBesideEachOther) {
  const auto truth = rig_with_planes({{0, -16}, {0, -8}, {0, 0}, {0, 8}, {0, 16}});
  const auto result = calibrate_rig(observe(truth, kPerfect), brown5());
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_planes(result.rig, truth);
  EXPECT_GT(result.rig.sensors[0].depth_range_mm[1], result.rig.sensors[0].depth_range_mm[0]);
}

TEST(SeveralPlanes, StripesInAnotherOrderInSomeViews) {
  const auto truth = rig_with_planes({{0, -10}, {0, 10}});
  auto observations = observe(truth, kPerfect);
  for (std::size_t i = 0; i < 4; ++i)
    std::swap(observations.sensors[0].views[3 * i].stripes[0],
              observations.sensors[0].views[3 * i].stripes[1]);
  const auto result = calibrate_rig(observations, brown5());
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_planes(result.rig, truth);
  for (const auto& view : result.summary.views) EXPECT_EQ(view.left_out, 0) << view.image;
}

TEST(SeveralPlanes, CrossedLinesAreToldApartByTheirDirection) {
  const auto truth = rig_with_planes({{-35, 0}, {35, 0}});
  auto observations = observe(truth, kPerfect);
  // By their mean place, which for lines that cross on the board is chance.
  for (auto& view : observations.sensors[0].views)
    std::sort(view.stripes.begin(), view.stripes.end(), [](const auto& a, const auto& b) {
      const auto mean_x = [](const auto& stripe) {
        double sum = 0;
        for (const auto& p : stripe) sum += p.x;
        return sum / std::max<double>(1, static_cast<double>(stripe.size()));
      };
      return mean_x(a) < mean_x(b);
    });
  const auto result = calibrate_rig(observations, brown5());
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_planes(result.rig, truth);
}

TEST(SeveralPlanes, AMissedStripeDoesNotShiftTheOthers) {
  const auto truth = rig_with_planes({{0, -14}, {0, 0}, {0, 14}});
  auto observations = observe(truth, kPerfect);
  for (std::size_t i = 0; i < observations.sensors[0].views.size(); i += 3) {
    auto& stripes = observations.sensors[0].views[i].stripes;  // the first is missed, the others move up
    stripes.erase(stripes.begin());
  }
  const auto result = calibrate_rig(observations, brown5());
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_planes(result.rig, truth);
}

}  // namespace
}  // namespace lightstripe
