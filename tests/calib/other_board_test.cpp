// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/other_board.h"

#include <gtest/gtest.h>

#include "calib/board/observe_board.h"
#include "rendered_board.h"

namespace lightstripe {
namespace {

const Camera kCamera{640, 480, 1100, 1102, 322, 238, {-0.1, 0.1, 3e-4, -2e-4}};
const Target kBoard{TargetType::kCheckerboard, 9, 6, 10, 10};

CornerGrid grid_of(const std::vector<Eigen::Vector2d>& corners, int columns, int rows) {
  CornerGrid grid{columns, rows, {}};
  grid.cells.assign(corners.begin(), corners.end());
  return grid;
}

TEST(OtherBoard, AWholeBoardOfAnotherSizeIsOneAndAPartIsNot) {
  const Rigid3 pose = testing::board_pose(kBoard, {0, 0, 600}, 20, -10, 15);
  const Image8 image = testing::render_board(kCamera, kBoard, pose);
  const cv::Mat gray(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.view().data),
                     static_cast<std::size_t>(image.view().stride));
  const CornerGrid whole = grid_of(testing::true_corners(kCamera, kBoard, pose), 9, 6);
  const Target larger{TargetType::kCheckerboard, 10, 7, 10, 10},
      smaller{TargetType::kCheckerboard, 8, 5, 10, 10};
  EXPECT_TRUE(is_other_board(gray, whole, larger));
  EXPECT_TRUE(is_other_board(gray, whole, smaller));
  EXPECT_FALSE(is_other_board(gray, whole, kBoard));
  EXPECT_FALSE(is_other_board(gray, turned(whole), kBoard));
  // A row that was missed: the squares go on beyond the corners.
  EXPECT_FALSE(is_other_board(gray, part(whole, 0, 0, 9, 5), kBoard));
  EXPECT_FALSE(is_other_board(gray, part(whole, 1, 0, 8, 6), kBoard));
}

TEST(OtherBoard, TheOuterEdgeOfTheSquaresIsNoRowOfCorners) {
  const Rigid3 pose = testing::board_pose(kBoard, {0, 0, 600}, 20, -10, 15);
  const Image8 image = testing::render_board(kCamera, kBoard, pose);
  const cv::Mat gray(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.view().data),
                     static_cast<std::size_t>(image.view().stride));
  EXPECT_TRUE(has_squares_beyond(gray, testing::true_corners(kCamera, kBoard, pose), kBoard));
  const Target one_more{TargetType::kCheckerboard, 9, 7, 10, 10};
  EXPECT_FALSE(has_squares_beyond(gray, testing::true_corners(kCamera, one_more, pose), one_more));
}

TEST(OtherBoard, ABoardIsNotFoundAsOneOfAnotherSize) {
  for (const auto& [columns, rows] : {std::pair{9, 7}, {8, 5}, {10, 7}, {10, 6}, {9, 5}, {7, 7}})
    for (const double tilt : {0.0, 30.0}) {
      const Rigid3 pose = testing::board_pose(kBoard, {2, 3, 620}, tilt, -0.7 * tilt, 0.5 * tilt);
      const Target wrong{TargetType::kCheckerboard, columns, rows, 10, 10};
      const auto seen = detect_board(testing::render_board(kCamera, kBoard, pose).view(), wrong);
      EXPECT_FALSE(seen.found) << columns << " x " << rows << " at " << tilt;
      EXPECT_EQ(std::max(seen.seen_columns, seen.seen_rows), 9);
      EXPECT_EQ(std::min(seen.seen_columns, seen.seen_rows), 6);
    }
}

}  // namespace
}  // namespace lightstripe
