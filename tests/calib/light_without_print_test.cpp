// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/light_without_print.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/adjust/stripe_crossing.h"
#include "calib/board/observe_board.h"
#include "extraction/image/background.h"
#include "rendered_board.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using testing::board_pose;
using testing::BoardLook;
using testing::true_corners;

const Target kBoard{TargetType::kCheckerboard, 11, 8, 10, 10};
const Camera kCamera{960, 700, 1640, 1640, 480, 350, {-0.1, 0.1, 3e-4, -2e-4}};
const Plane kLaser = [] {
  const Eigen::Vector3d n = Eigen::Vector3d(0.1, 1, 0.6).normalized();
  return Plane{n, n.dot(Eigen::Vector3d(0, 2, 550))};
}();

BoardMap map_of(const Rigid3& pose) {
  return fit_board_map(true_corners(kCamera, kBoard, pose), kBoard).value();
}

struct Rest {
  double mean = 0, rms = 0;
};

Rest rest_of(const Image8& light) {
  Rest rest;
  for (const auto pixel : light.pixels) {
    const double d = pixel - kDarkLevel;
    rest.mean += d / static_cast<double>(light.pixels.size());
    rest.rms += d * d / static_cast<double>(light.pixels.size());
  }
  rest.rms = std::sqrt(rest.rms);
  return rest;
}

TEST(LightWithoutPrint, LeavesTheNoiseOfABoardWithoutLaser) {
  // Noise of 1.5 levels is what may be left, and a little at the edges, whatever the lens's blur.
  for (const double blur_px : {0.6, 1.2, 2.0}) {
    const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 20, 25, 15);
    const Image8 picture = testing::render_board(kCamera, kBoard, pose, {.blur_px = blur_px}, 1);
    const auto light = light_without_print(picture, map_of(pose), kBoard);
    ASSERT_TRUE(light);
    const Rest rest = rest_of(*light);
    EXPECT_LT(rest.rms, 2.5) << blur_px;
    EXPECT_LT(std::abs(rest.mean), 0.2) << blur_px;
  }
}

TEST(LightWithoutPrint, KeepsTheLaserOnLightAndDarkSquares) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 12, 20, 30);
  const BoardLook look{
      .dark = 25, .light = 110, .laser_peak = 100, .laser_sigma_mm = 0.5, .laser_dark_albedo = 0.3};
  const std::vector<Plane> lasers{kLaser};
  const Image8 with = testing::render_board(kCamera, kBoard, pose, look, 1, lasers);
  const Image8 without = testing::render_board(kCamera, kBoard, pose, look, 2);
  const auto light = light_without_print(with, map_of(pose), kBoard);
  ASSERT_TRUE(light);
  double sum = 0;
  int lit = 0;
  for (int y = 0; y < with.height; ++y) {
    for (int x = 0; x < with.width; ++x) {
      const int truth = with(x, y) - without(x, y);
      if (truth < 20) continue;
      ++lit;
      sum += std::abs((*light)(x, y) - kDarkLevel - truth);
    }
  }
  ASSERT_GT(lit, 1000);
  EXPECT_LT(sum / lit, 4);  // both pictures' noise of 1.5 leaves 1.7
}

TEST(LightWithoutPrint, RefusesOtherTargetsAndTinySquares) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 550}, 12, 20, 0);
  Target circles = kBoard;
  circles.type = TargetType::kCircles;
  EXPECT_FALSE(light_without_print(Image8(960, 700, 10), map_of(pose), circles));
  std::vector<Eigen::Vector2d> tiny;
  for (const auto& corner : true_corners(kCamera, kBoard, pose)) tiny.emplace_back(corner / 10);
  EXPECT_FALSE(light_without_print(Image8(960, 700, 10), fit_board_map(tiny, kBoard).value(), kBoard));
}

TEST(FindStripeOnBoard, FindsALineThatIsFainterThanThePrint) {
  // Board and laser in one picture of a lit room: the line adds 60 levels to squares that differ by 110, and
  // among light squares it is no longer than a square.
  const BoardLook look{.dark = 25,
                       .light = 135,
                       .background = 10,
                       .noise = 2.5,
                       .laser_peak = 60,
                       .laser_sigma_mm = 0.5,
                       .laser_dark_albedo = 0.15};
  const std::vector<Plane> lasers{kLaser};
  for (int i = 0; i < 6; ++i) {
    const Rigid3 pose = board_pose(kBoard, {0, 0, 540.0 + 10 * i}, 5.0 * i - 15, 10, 12.0 * i - 30);
    const Image8 picture = testing::render_board(kCamera, kBoard, pose, look, 1, lasers);
    const auto found =
        find_stripe_on_board(picture, ImageView8(), true_corners(kCamera, kBoard, pose), kBoard, 1, {});
    ASSERT_TRUE(found.reason.empty()) << i << ": " << found.reason;
    double sum = 0;
    for (const StripePoint& p : found.planes[0]) {
      const auto crossing = stripe_crossing(kCamera, board_plane(pose), kLaser, {p.x, p.y});
      ASSERT_TRUE(crossing);
      sum += crossing->distance_px * crossing->distance_px;
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(found.planes[0].size())), 0.15) << i;
  }
}

}  // namespace
}  // namespace lightstripe
