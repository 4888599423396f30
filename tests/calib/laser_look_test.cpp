// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/laser_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendered_board.h"

namespace lightstripe {
namespace {

using testing::board_pose;
using testing::BoardLook;
using ::testing::HasSubstr;
using testing::render_board;
using testing::true_corners;

const Camera kCamera{480, 360, 825, 824, 242, 178, {}};
const Target kTarget{TargetType::kCheckerboard, 11, 8, 10, 10};

/// A line across the board along its x at y_mm.
std::vector<StripePoint> line_at(const Rigid3& pose, double y_mm) {
  std::vector<StripePoint> line;
  for (double x = -8; x <= 108; x += 1) {
    const auto q = project(kCamera, pose * Eigen::Vector3d(x, y_mm, 0)).value();
    line.push_back({.x = q.x(), .y = q.y(), .normal_y = 1, .width = 4});
  }
  return line;
}

std::string look_of(const Image8& image, const Rigid3& pose, const std::vector<StripePoint>& line) {
  const auto corners = true_corners(kCamera, kTarget, pose);
  return no_laser_because(image.view(), line, corners, fit_board_map(corners, kTarget).value(), kTarget);
}

TEST(LaserLook, ALineBrighterThanThePrintIsALaser) {
  const auto pose = board_pose(kTarget, {0, 0, 500}, 0, 0, 0);
  const Plane laser{Eigen::Vector3d::UnitY(), 8.5};  // board y = 43.5
  const auto image = render_board(
      kCamera, kTarget, pose,
      {.dark = 30, .light = 120, .laser_peak = 110, .laser_sigma_mm = 0.8, .laser_dark_albedo = 0.4}, 1,
      std::span(&laser, 1));
  EXPECT_EQ(look_of(image, pose, line_at(pose, 43.5)), "");
}

TEST(LaserLook, ALineAsBrightAsTheSquaresIsPrint) {
  const auto pose = board_pose(kTarget, {0, 0, 500}, 0, 0, 0);
  const auto image = render_board(kCamera, kTarget, pose, {.dark = 30, .light = 120});
  EXPECT_THAT(look_of(image, pose, line_at(pose, 43.5)), HasSubstr("looks like print"));
}

TEST(LaserLook, ALineAlongTheBorderIsTheRim) {
  const auto pose = board_pose(kTarget, {0, 0, 500}, 0, 0, 0);
  const auto image = render_board(kCamera, kTarget, pose, {});
  EXPECT_THAT(look_of(image, pose, line_at(pose, -12)), HasSubstr("board's rim"));
}

}  // namespace
}  // namespace lightstripe
