// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A laser plane from blocks of known heights over a bed, with a known camera.
#include "calib/start/height_lines.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/adjust/board_surface.h"
#include "calib/board/straight_lines.h"
#include "calib/calibrate_rig.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

constexpr double kStripeNoisePx = 0.07;  // as in rendered pictures; corners have half of it
const std::vector<double> kHeights{2.5, 5, 10, 15, 20, 30, 40, 50, 65, 80};

/// A rig that looks down at a bed 600 mm away.
struct Bench {
  testing::SyntheticRig rig = testing::rail_rig(1, 2);
  Rigid3 cam_from_board{Eigen::Quaterniond(Eigen::AngleAxisd(8 * kDegree, Vector3d::UnitX())),
                        {-50, -35, 600}};
  const SensorState& sensor() const { return rig.sensors[0]; }
};

/// The laser on the plane `height` over the board, where x of the board lies between two limits.
std::vector<StripePoint> line_at(const Bench& bench, double height, double from_mm, double to_mm,
                                 double noise_px, Random& random) {
  Target wide = bench.rig.target;
  auto points = testing::seen_stripe(wide, bench.sensor(), raised(bench.cam_from_board, height), 4);
  std::vector<StripePoint> kept;
  for (auto point : points) {
    const auto place =
        seen_place_on_top(bench.sensor().camera, bench.cam_from_board, height, {point.x, point.y});
    if (!place || place->xy.x() < from_mm || place->xy.x() > to_mm) continue;
    const double shift = noise_px * random.gaussian();
    point.x += shift * point.normal_x;
    point.y += shift * point.normal_y;
    point.sigma_px = noise_px;
    point.width = 3.5;
    kept.push_back(point);
  }
  return kept;
}

CalibrationObservations session(const Bench& bench, double noise_px) {
  Random random(5);
  CalibrationObservations observations;
  observations.target = bench.rig.target;
  SensorObservations sensor;
  sensor.name = "gauge";
  sensor.width = 960;
  sensor.height = 700;
  sensor.given_camera = GivenCamera{bench.sensor().camera, true};
  BedObservations bed;
  bed.board.image = "bed.png";
  bed.board.corners = testing::seen_corners(bench.rig.target, bench.sensor().camera, bench.cam_from_board);
  for (auto& corner : bed.board.corners)
    corner += 0.5 * noise_px * Eigen::Vector2d(random.gaussian(), random.gaussian());
  for (const double height : kHeights) {
    HeightView view{fmt::format("{}.png", height), height, {}};
    view.lines.push_back(line_at(bench, 0, -10, 15, noise_px, random));  // the bed beside the block
    view.lines.push_back(line_at(bench, height, 20, 80, noise_px, random));
    view.lines.push_back(line_at(bench, 0, 85, 110, noise_px, random));
    bed.heights.push_back(std::move(view));
  }
  sensor.bed = std::move(bed);
  observations.sensors.push_back(std::move(sensor));
  return observations;
}

/// Rms of the heights that the rig measures on new lines, mm.
double height_error_mm(const Bench& bench, const Plane& laser, const Rigid3& cam_from_board) {
  Random random(77);
  double sum = 0;
  int count = 0;
  const Rigid3 board_from_cam = cam_from_board.inverse();
  for (const double height : kHeights) {
    for (const auto& point : line_at(bench, height, 20, 80, 0, random)) {
      const auto p =
          intersect(laser, Vector3d::Zero(), *unproject(bench.sensor().camera, {point.x, point.y}));
      const double error = -(board_from_cam * *p).z() - height;
      sum += error * error;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(KnownHeights, TenBlocksGiveHeightsToThreeHundredthsOfAMillimetre) {
  const Bench bench;
  const auto result = calibrate_rig(session(bench, kStripeNoisePx), {});
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  ASSERT_EQ(result.summary.stripes.size(), 1U);
  EXPECT_EQ(result.summary.stripes[0].agreeing, 10);
  const Plane& laser = result.rig.sensors[0].laser_planes[0];
  EXPECT_LT(height_error_mm(bench, laser, bench.cam_from_board), 0.03);
  const double angle = std::asin(laser.normal.cross(bench.sensor().laser_planes[0].normal).norm()) / kDegree;
  EXPECT_LT(angle, 4 * result.rig.quality.sigma.at("gauge.laser_planes.0.normal_deg"));
}

TEST(KnownHeights, HeightsInAWrongOrderAreRefused) {
  const Bench bench;
  auto observations = session(bench, kStripeNoisePx);
  auto& heights = observations.sensors[0].bed->heights;
  const auto before = heights;
  for (std::size_t i = 0; i < heights.size(); ++i)
    heights[i].height_mm = before[(i * 3 + 2) % heights.size()].height_mm;
  const auto result = calibrate_rig(observations, {});
  EXPECT_FALSE(result.summary.usable) << result.summary.message;
}

TEST(StraightLines, AStepBreaksALineInTwo) {
  Stripe stripe;
  for (int x = 0; x < 200; ++x) {
    StripePoint point;
    point.x = x;
    point.y = x < 120 ? 50 + 0.1 * x : 80 + 0.1 * x;
    stripe.points.push_back(point);
  }
  const auto lines = straight_lines({stripe});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].size(), 120U);
  EXPECT_EQ(lines[1].size(), 80U);
}

}  // namespace
}  // namespace lightstripe
