// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/saddle_corners.h"

#include <gtest/gtest.h>

#include "rendered_board.h"

namespace lightstripe {
namespace {

const Camera kCamera{640, 480, 1100, 1102, 322, 238, {-0.1, 0.1, 3e-4, -2e-4}};
const Target kBoard{TargetType::kCheckerboard, 9, 6, 10, 10};

cv::Mat as_mat(const Image8& image) {
  return cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.view().data),
                 static_cast<std::size_t>(image.view().stride))
      .clone();
}

const SaddleCorner* nearest(const std::vector<SaddleCorner>& found, const Eigen::Vector2d& place) {
  const SaddleCorner* best = nullptr;
  for (const auto& one : found)
    if (!best || (one.position - place).norm() < (best->position - place).norm()) best = &one;
  return best;
}

TEST(SaddleCorners, AllOfABoardWithEdgesAlongItsRows) {
  const Rigid3 pose = testing::board_pose(kBoard, {0, 0, 600}, 25, -15, 20);
  const auto found = find_saddle_corners(as_mat(testing::render_board(kCamera, kBoard, pose)));
  const auto corners = testing::true_corners(kCamera, kBoard, pose);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const SaddleCorner* corner = nearest(found, corners[i]);
    ASSERT_TRUE(corner);
    EXPECT_LT((corner->position - corners[i]).norm(), 1.0) << i;
    if (i % 9 == 8) continue;
    const Eigen::Vector2d along = (corners[i + 1] - corners[i]).normalized();
    const double cosine =
        std::max(std::abs(corner->edges[0].dot(along)), std::abs(corner->edges[1].dot(along)));
    EXPECT_GT(cosine, std::cos(0.15)) << i;
  }
}

TEST(SaddleCorners, NeighboursHaveTheirDarkSectorsTheOtherWayRound) {
  const Rigid3 pose = testing::board_pose(kBoard, {0, 0, 600}, 0, 0, 10);
  const auto found = find_saddle_corners(as_mat(testing::render_board(kCamera, kBoard, pose)));
  const auto corners = testing::true_corners(kCamera, kBoard, pose);
  const auto along_rows = [&](std::size_t i) {  // whether the first edge is the row's
    const Eigen::Vector2d along = (corners[1] - corners[0]).normalized();
    return std::abs(nearest(found, corners[i])->edges[0].dot(along)) > 0.7;
  };
  for (std::size_t i = 0; i + 1 < 9; ++i) EXPECT_NE(along_rows(i), along_rows(i + 1)) << i;
}

TEST(SaddleCorners, NoneInAnEdgeABarOrNoise) {
  cv::Mat edge(200, 300, CV_8U, cv::Scalar(40));
  edge.colRange(150, 300).setTo(200);
  edge.rowRange(90, 110).setTo(120);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x)
      edge.at<std::uint8_t>(y, x) += static_cast<std::uint8_t>((x * 7 + y * 13) % 5);
  EXPECT_LE(find_saddle_corners(edge).size(), 2u);  // the bar's mixed grey may look like one where it ends
  EXPECT_TRUE(find_saddle_corners(cv::Mat(50, 50, CV_8U, cv::Scalar(90))).empty());
}

}  // namespace
}  // namespace lightstripe
