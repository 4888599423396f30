// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/board/board_reasons.h"
#include "calib/board/corner_grid.h"
#include "calib/board/observe_board.h"
#include "rendered_board.h"

namespace lightstripe {
namespace {

using testing::board_pose;
using testing::BoardLook;
using ::testing::HasSubstr;
using testing::render_board;
using testing::true_corners;

const Camera kCamera{640, 480, 1100, 1102, 322, 238, {-0.1, 0.1, 3e-4, -2e-4}};
const Target kBoard{TargetType::kCheckerboard, 11, 8, 10, 10};

/// Root mean square over coordinates, px.
double rms_error(const std::vector<Eigen::Vector2d>& found, const std::vector<Eigen::Vector2d>& known) {
  double sum = 0;
  for (std::size_t i = 0; i < known.size(); ++i) sum += (found.at(i) - known[i]).squaredNorm() / 2;
  return std::sqrt(sum / static_cast<double>(known.size()));
}

TEST(DetectBoard, FindsCornersToAFewHundredthsOfAPixel) {
  // Budget: cv::cornerSubPix with 1.5 grey levels of noise at 160 of contrast is at 0.02 to 0.05 px a
  // coordinate.
  for (const double blur_px : {0.5, 0.9, 1.5}) {
    for (const double tilt_deg : {0.0, 25.0, 45.0}) {
      const Rigid3 pose = board_pose(kBoard, {3, -2, 520}, tilt_deg, 0.6 * tilt_deg, 10);
      const auto found =
          detect_board(render_board(kCamera, kBoard, pose, {.blur_px = blur_px}).view(), kBoard);
      ASSERT_TRUE(found.found) << found.reason;
      EXPECT_LT(rms_error(found.corners, true_corners(kCamera, kBoard, pose)), 0.08)
          << blur_px << " " << tilt_deg;
    }
  }
}

TEST(DetectBoard, ListsCornersByHandednessAndColours) {
  // Columns + rows odd: only one order has the dark square first, whichever way the board is turned.
  for (const double turn_deg : {0.0, 90.0, 180.0, 200.0, 270.0}) {
    const Rigid3 pose = board_pose(kBoard, {0, 0, 560}, 10, -15, turn_deg);
    const auto found = detect_board(render_board(kCamera, kBoard, pose).view(), kBoard);
    ASSERT_TRUE(found.found) << found.reason;
    EXPECT_LT(rms_error(found.corners, true_corners(kCamera, kBoard, pose)), 0.1) << turn_deg;
  }
}

TEST(DetectBoard, KeepsARightHandedOrderOfASymmetricBoard) {
  const Target board{TargetType::kCheckerboard, 9, 7, 10, 12};
  for (const double turn_deg : {5.0, 120.0, 250.0}) {
    const Rigid3 pose = board_pose(board, {0, 0, 560}, 10, -15, turn_deg);
    const auto found = detect_board(render_board(kCamera, board, pose).view(), board);
    ASSERT_TRUE(found.found) << found.reason;
    auto known = true_corners(kCamera, board, pose);
    const double upright = rms_error(found.corners, known);
    std::reverse(known.begin(), known.end());
    EXPECT_LT(std::min(upright, rms_error(found.corners, known)), 0.1);
  }
}

TEST(DetectBoard, TellsWhichCornersTheLaserHasPulledAway) {
  // A bright line almost along a row of corners: what it pulls by more than a tenth of a square is unseen,
  // the others stay right.
  const Rigid3 pose = board_pose(kBoard, {0, 0, 520}, 10, -15, 5);
  const Eigen::Vector3d from = pose * Eigen::Vector3d(0, 28.5, 0), to = pose * Eigen::Vector3d(100, 32, 0);
  const Eigen::Vector3d across = (to - from).cross(pose.rotation * Eigen::Vector3d(0, 0.3, 1)).normalized();
  const std::vector<Plane> laser{{across, across.dot(from)}};
  const BoardLook look{.dark = 15,
                       .light = 100,
                       .background = 5,
                       .laser_peak = 500,
                       .laser_sigma_mm = 0.6,
                       .laser_dark_albedo = 0.1};
  const auto found = detect_board(render_board(kCamera, kBoard, pose, look, 1, laser).view(), kBoard);
  ASSERT_TRUE(found.found) << found.reason;
  const auto truth = true_corners(kCamera, kBoard, pose);
  int unseen = 0;
  double largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool seen = found.corners[i].allFinite();
    unseen += !seen;
    if (seen) largest = std::max(largest, (found.corners[i] - truth[i]).norm());
  }
  EXPECT_GE(unseen, 1);
  EXPECT_LE(unseen, 8);
  EXPECT_LT(largest, 2.5);  // a square is 21 px
}

TEST(DetectBoard, FindsTheBoardBesideAnotherPattern) {
  // A darker board of 9 x 6 corners below; the two nearly touch.
  const Target other{TargetType::kCheckerboard, 9, 6, 8, 8};
  const Rigid3 pose = board_pose(kBoard, {0, -25, 700}, 35, 5, 3),
               beside = board_pose(other, {0, 55, 690}, -30, 0, 0);
  const BoardLook faint{.dark = 70, .light = 140, .background = 90, .margin_mm = 2};
  Image8 image = render_board(kCamera, kBoard, pose, faint, 1);
  const Image8 second =
      render_board(kCamera, other, beside, {.dark = 10, .light = 250, .background = 0, .margin_mm = 2}, 2);
  for (int y = 300; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (second(x, y) > 5 || image(x, y) == 90) image(x, y) = second(x, y);
  const auto found = detect_board(image.view(), kBoard);
  ASSERT_TRUE(found.found) << found.reason;
  EXPECT_LT(rms_error(found.corners, true_corners(kCamera, kBoard, pose)), 0.15);
}

TEST(DetectBoard, SearchesLargePicturesAtAFractionOfTheirSize) {
  Camera large = kCamera;
  for (double* value : {&large.fx, &large.fy, &large.cx, &large.cy}) *value *= 4;
  large.width *= 4;
  large.height *= 4;
  const Rigid3 pose = board_pose(kBoard, {0, 0, 520}, 20, 10, 10);
  const auto found = detect_board(render_board(large, kBoard, pose, {.blur_px = 2}).view(), kBoard);
  ASSERT_TRUE(found.found) << found.reason;
  EXPECT_LT(rms_error(found.corners, true_corners(large, kBoard, pose)), 0.08);
}

TEST(DetectBoard, TakesTheFirstCandidateThatShowsTheBoard) {
  const Rigid3 pose = board_pose(kBoard, {0, 0, 520}, 20, 10, 10);
  const Image8 dark(640, 480, 5), good = render_board(kCamera, kBoard, pose);
  const ImageView8 candidates[] = {dark.view(), good.view(), good.view()};
  const auto found = detect_board(candidates, kBoard);
  EXPECT_TRUE(found.found);
  EXPECT_EQ(found.image, 1u);
  const ImageView8 none[] = {dark.view(), dark.view()};
  EXPECT_THAT(detect_board(none, kBoard).reason, HasSubstr("too dark"));
  EXPECT_FALSE(detect_board(std::span<const ImageView8>{}, kBoard).found);
}

TEST(DetectBoard, SaysThatAPictureIsDarkOrFlatOrEmpty) {
  EXPECT_THAT(detect_board(Image8(640, 480, 12).view(), kBoard).reason, HasSubstr("too dark"));
  EXPECT_THAT(detect_board(Image8(640, 480, 120).view(), kBoard).reason, HasSubstr("no contrast"));
  EXPECT_THAT(detect_board(ImageView8{}, kBoard).reason, HasSubstr("empty"));
}

TEST(DetectBoard, SaysWhichSizeItSaw) {
  const Target shown{TargetType::kCheckerboard, 10, 7, 10, 10};
  const auto image = render_board(kCamera, shown, board_pose(shown, {0, 0, 560}, 15, 10, 5));
  EXPECT_THAT(detect_board(image.view(), kBoard).reason,
              HasSubstr("the board shows 10 x 7 inner corners, the session says 11 x 8"));
  const Target larger{TargetType::kCheckerboard, 12, 8, 10, 10};
  const auto wide = render_board(kCamera, larger, board_pose(larger, {0, 0, 560}, 15, 10, 5));
  EXPECT_THAT(detect_board(wide.view(), kBoard).reason,
              HasSubstr("the board shows 12 x 8 inner corners, the session says 11 x 8"));
}

TEST(DetectBoard, SaysThatTheBoardIsCutOff) {
  const auto image = render_board(kCamera, kBoard, board_pose(kBoard, {110, 0, 520}, 10, 10, 0));
  EXPECT_THAT(detect_board(image.view(), kBoard).reason, HasSubstr("cut off"));
}

TEST(DetectBoard, SaysThatThePictureIsBlurred) {
  const auto image =
      render_board(kCamera, kBoard, board_pose(kBoard, {0, 0, 520}, 10, 10, 0), {.blur_px = 11});
  EXPECT_THAT(detect_board(image.view(), kBoard).reason, HasSubstr("blurred"));
}

TEST(DetectBoard, SaysThatThereIsNoBoard) {
  Image8 image(640, 480, 60);
  for (int y = 100; y < 300; ++y)
    for (int x = 200; x < 400; ++x) image(x, y) = 200;
  EXPECT_THAT(detect_board(image.view(), kBoard).reason,
              HasSubstr("no board of 11 x 8 inner corners in view"));
}

TEST(EdgeWidth, FollowsTheBlur) {
  // 10 to 90 % of an edge blurred by s is 2.56 s wide.
  for (const double blur_px : {2.0, 4.0}) {
    const auto image = render_board(kCamera, kBoard, board_pose(kBoard, {0, 0, 520}, 0, 0, 0),
                                    {.blur_px = blur_px, .noise = 0});
    const cv::Mat gray(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
    EXPECT_NEAR(edge_width_px(gray), 2.56 * blur_px, 0.25 * 2.56 * blur_px);
  }
}

TEST(LinkCorners, LeavesOutAPatternOnAnotherPlane) {
  // Two boards that meet at a fold: links cross it, but steps there are of another length.
  std::vector<SaddleCorner> corners;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 6; ++x) {
      const bool below = y >= 5;
      SaddleCorner corner;
      corner.position = {100 + 30.0 * x, below ? 100 + 4 * 30.0 + 14 * (y - 4) : 100 + 30.0 * y};
      const bool even = (x + y) % 2 == 0;
      corner.edges = {even ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1),
                      even ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(-1, 0)};
      corners.push_back(corner);
    }
  }
  const auto grids = link_corners(corners);
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].count(), 30);
  EXPECT_EQ(grids[1].count(), 18);
}

}  // namespace
}  // namespace lightstripe
