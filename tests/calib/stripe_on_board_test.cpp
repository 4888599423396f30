// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/adjust/stripe_crossing.h"
#include "calib/board/board_map.h"
#include "calib/board/observe_board.h"
#include "rendered_board.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using testing::board_pose;
using ::testing::HasSubstr;
using testing::true_corners;

const Target kBoard{TargetType::kCheckerboard, 11, 8, 10, 10};
const Camera kCamera{960, 700, 1640, 1640, 480, 350, {-0.1, 0.1, 3e-4, -2e-4}};

SensorState sensor_with(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  const Eigen::Vector3d n = normal.normalized();
  return {kCamera, {}, {{n, n.dot(point)}}};
}

/// A stripe along the board's y direction (upright in the picture) and one along x.
const SensorState kUpright = sensor_with({1, 0.1, -0.3}, {3, 0, 550});
const SensorState kFlat = sensor_with({0.1, 1, 0.6}, {0, 2, 550});

double distance_px(const StripePoint& point, const SensorState& sensor, const Rigid3& cam_from_board) {
  const auto frame =
      stripe_crossing(sensor.camera, board_plane(cam_from_board), sensor.laser_planes[0], {point.x, point.y});
  return frame ? frame->distance_px : 1e9;
}

Stripe as_stripe(std::vector<StripePoint> points) {
  for (auto& point : points) point.width = 6;
  return {std::move(points)};
}

TEST(BoardMap, FollowsADistortedBoard) {
  Camera camera = kCamera;
  camera.distortion = {-0.3, 0.1, 1e-3, -1e-3};
  const Rigid3 pose = board_pose(kBoard, {10, 5, 500}, 30, -20, 15);
  const auto map = fit_board_map(true_corners(camera, kBoard, pose), kBoard);
  ASSERT_TRUE(map);
  // Between corners, and a square beyond them.
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(34, 27), Eigen::Vector2d(-10, 75), Eigen::Vector2d(109, -9)}) {
    const auto pixel = project(camera, pose * Eigen::Vector3d(p.x(), p.y(), 0));
    EXPECT_LT(((*map)(*pixel) - p).norm(), 0.05);  // mm; a pixel is 0.3 mm
    const auto next = project(camera, pose * Eigen::Vector3d(p.x() + 0.1, p.y(), 0));
    EXPECT_LT((map->derivative(*pixel) * (*next - *pixel) - Eigen::Vector2d(0.1, 0)).norm(), 0.003);
  }
}

TEST(SelectStripes, KeepsThePointsOnTheBoard) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 10, 20, 5);
  auto points = testing::seen_stripe(kBoard, kUpright, pose, 1);
  const std::size_t on_board = points.size();
  ASSERT_GT(on_board, 200u);
  auto beyond = points;
  for (auto& point : beyond) point.y += 600;  // below the board
  points.insert(points.end(), beyond.begin(), beyond.end());
  const auto selected = select_stripes({as_stripe(points)}, true_corners(kCamera, kBoard, pose), kBoard, 1);
  ASSERT_EQ(selected.planes.size(), 1u) << selected.reason;
  EXPECT_GT(selected.planes[0].size(), on_board / 3);
  for (const auto& point : selected.planes[0]) EXPECT_LT(std::abs(distance_px(point, kUpright, pose)), 0.05);
}

TEST(SelectStripes, LeavesOutPointsNearEdgesAlongTheStripeButNotNearEdgesAcross) {
  // A board seen straight on with the stripe exactly along its columns, 1.5 mm (4.5 px) beside a column of
  // corners, or in the squares' middle.
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 0, 0, 0);
  const auto corners = true_corners(kCamera, kBoard, pose);
  const auto kept_share = [&](double beside_mm) {
    const SensorState sensor = sensor_with({1, 0, -0.3}, {beside_mm, 0, 550});
    const auto points = testing::seen_stripe(kBoard, sensor, pose, 1);
    const auto selected = select_stripes({as_stripe(points)}, corners, kBoard, 1);
    return static_cast<double>(selected.planes.at(0).size()) / static_cast<double>(points.size());
  };
  EXPECT_EQ(kept_share(1.0), 0);
  EXPECT_GT(kept_share(5.0), 0.95);
}

TEST(SelectStripes, RejectsAReflectionBesideTheStripe) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 10, 20, 5);
  const auto points = testing::seen_stripe(kBoard, kUpright, pose, 1);
  auto reflection = points;
  reflection.resize(points.size() / 2);
  for (std::size_t i = 0; i < reflection.size(); ++i) reflection[i].x += 40 + 0.2 * static_cast<double>(i);
  const auto selected = select_stripes({as_stripe(reflection), as_stripe(points)},
                                       true_corners(kCamera, kBoard, pose), kBoard, 1);
  ASSERT_EQ(selected.planes.size(), 1u) << selected.reason;
  for (const auto& point : selected.planes[0]) EXPECT_LT(std::abs(distance_px(point, kUpright, pose)), 0.05);
}

TEST(SelectStripes, OrdersSeveralLinesFromLeftToRight) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 10, 20, 5);
  const SensorState left = sensor_with({1, 0.1, -0.3}, {-20, 0, 550});
  const auto a = as_stripe(testing::seen_stripe(kBoard, kUpright, pose, 1)),
             b = as_stripe(testing::seen_stripe(kBoard, left, pose, 1));
  const auto selected = select_stripes({a, b}, true_corners(kCamera, kBoard, pose), kBoard, 2);
  ASSERT_EQ(selected.planes.size(), 2u) << selected.reason;
  EXPECT_LT(std::abs(distance_px(selected.planes[0].front(), left, pose)), 0.05);
  EXPECT_LT(std::abs(distance_px(selected.planes[1].front(), kUpright, pose)), 0.05);
}

TEST(SelectStripes, SaysWhatIsMissing) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 10, 20, 5);
  const auto corners = true_corners(kCamera, kBoard, pose);
  EXPECT_THAT(select_stripes({}, corners, kBoard, 1).reason, HasSubstr("no light on the board"));
  const auto one = as_stripe(testing::seen_stripe(kBoard, kUpright, pose, 1));
  EXPECT_THAT(select_stripes({one}, corners, kBoard, 2).reason, HasSubstr("1 of 2 stripes"));
  auto wide = one;
  for (auto& point : wide.points) point.width = 40;
  EXPECT_THAT(select_stripes({wide}, corners, kBoard, 1).reason,
              HasSubstr("only 0 independent points of it lie clear"));
}

struct Error {
  double mean = 0, rms = 0;
  std::size_t points = 0;
};

Error error_of(const std::vector<StripePoint>& points, const SensorState& sensor, const Rigid3& pose) {
  Error error;
  error.points = points.size();
  for (const auto& point : points) {
    const double d = distance_px(point, sensor, pose);
    error.mean += d / static_cast<double>(points.size());
    error.rms += d * d / static_cast<double>(points.size());
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

TEST(FindStripeOnBoard, MeasuresARenderedStripeToATenthOfAPixel) {
  // Oblique over the squares' edges; laser light on dark squares is a tenth of that on light ones. Budget:
  // extraction 0.03 px, edges 0.03 px, quantised difference of two noisy pictures on the dark squares 0.1 px.
  for (const SensorState& sensor : {kUpright, kFlat}) {
    for (const double turn_deg : {8.0, 30.0}) {
      const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 12, 20, turn_deg);
      const testing::BoardLook look{.dark = 25,
                                    .light = 110,
                                    .background = 40,
                                    .laser_peak = 140,
                                    .laser_sigma_mm = 0.5,
                                    .laser_dark_albedo = 0.15};
      const auto board = testing::render_board(kCamera, kBoard, pose, look, 1);
      const auto laser = testing::render_board(kCamera, kBoard, pose, look, 2, sensor.laser_planes);
      const auto found =
          find_stripe_on_board(laser, board, true_corners(kCamera, kBoard, pose), kBoard, 1, {});
      ASSERT_EQ(found.planes.size(), 1u) << found.reason;
      const Error error = error_of(found.planes[0], sensor, pose);
      EXPECT_GT(error.points, 60u);
      EXPECT_LT(error.rms, 0.1);
      EXPECT_LT(std::abs(error.mean), 0.03);
    }
  }
}

TEST(FindStripeOnBoard, FindsABroadStripeInTheDarkWhateverTheNoise) {
  // The laser picture is far darker than the board's, so that half of the difference's noise is negative.
  const testing::BoardLook bright{.dark = 20, .light = 190, .background = 10, .noise = 2};
  const testing::BoardLook dim{.dark = 8,
                               .light = 45,
                               .background = 5,
                               .noise = 2,
                               .laser_peak = 120,
                               .laser_sigma_mm = 0.9,
                               .laser_dark_albedo = 0.1};
  for (int i = 0; i < 6; ++i) {
    const Rigid3 pose = board_pose(kBoard, {0, 0, 540.0 + 10 * i}, 5.0 * i - 15, 10, 12.0 * i - 30);
    const auto board = testing::render_board(kCamera, kBoard, pose, bright, 1);
    const auto laser = testing::render_board(kCamera, kBoard, pose, dim, 2, kFlat.laser_planes);
    const auto found = find_stripe_on_board(laser, board, true_corners(kCamera, kBoard, pose), kBoard, 1, {});
    ASSERT_EQ(found.planes.size(), 1u) << i << ": " << found.reason;
    EXPECT_GT(found.planes[0].size(), 10u) << i;
  }
}

TEST(FindStripeOnBoard, RefusesPicturesOfDifferentSize) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 12, 20, 0);
  const Image8 laser(960, 700, 10), board(640, 480, 10);
  EXPECT_THAT(find_stripe_on_board(laser, board, true_corners(kCamera, kBoard, pose), kBoard, 1, {}).reason,
              HasSubstr("960 x 700"));
}

}  // namespace
}  // namespace lightstripe
