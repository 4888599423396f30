// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Saddle corners of a rendered board, and the grid that they make.
#include "calib/board/corner_grid.h"

#include <gtest/gtest.h>

#include "rendered_board.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using testing::board_pose;
using testing::render_board;
using testing::true_corners;

const Camera kCamera{640, 480, 825, 824, 322, 238, {-0.09, 0.1}};
const Target kTarget{TargetType::kCheckerboard, 9, 6, 12, 12};

class Corners : public ::testing::Test {
 protected:
  Rigid3 pose_ = board_pose(kTarget, {0, 0, 450}, 20, -25, 15);
  Image8 image_ = render_board(kCamera, kTarget, pose_);
  std::vector<SaddleCorner> found_ =
      find_saddle_corners(cv::Mat(image_.height, image_.width, CV_8U, image_.pixels.data()));
};

TEST_F(Corners, EveryInnerCornerIsASaddle) {
  for (const Vector2d& corner : true_corners(kCamera, kTarget, pose_)) {
    double nearest = 1e9;
    for (const auto& saddle : found_) nearest = std::min(nearest, (saddle.position - corner).norm());
    EXPECT_LT(nearest, 1.0);
  }
}

TEST_F(Corners, TheyMakeTheWholeGridRightHanded) {
  const auto grids = link_corners(found_);
  ASSERT_FALSE(grids.empty());
  const CornerGrid& grid = grids.front();
  EXPECT_EQ(std::max(grid.columns, grid.rows), 9);
  EXPECT_EQ(std::min(grid.columns, grid.rows), 6);
  EXPECT_EQ(grid.count(), 54);
  const Vector2d x = *grid.at(1, 0) - *grid.at(0, 0), y = *grid.at(0, 1) - *grid.at(0, 0);
  EXPECT_GT(x.x() * y.y() - x.y() * y.x(), 0);
}

TEST_F(Corners, PartsAndTurnsKeepTheirCorners) {
  const CornerGrid grid = link_corners(found_).front();
  const CornerGrid piece = part(grid, 1, 2, 3, 4);
  EXPECT_EQ(piece.columns, 3);
  EXPECT_EQ(piece.rows, 4);
  EXPECT_EQ(*piece.at(2, 3), *grid.at(3, 5));
  const CornerGrid other = turned(grid);
  EXPECT_EQ(other.columns, grid.rows);
  EXPECT_EQ(other.count(), grid.count());
  const Vector2d x = *other.at(1, 0) - *other.at(0, 0), y = *other.at(0, 1) - *other.at(0, 0);
  EXPECT_GT(x.x() * y.y() - x.y() * y.x(), 0);
}

}  // namespace
}  // namespace lightstripe
