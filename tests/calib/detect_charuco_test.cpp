// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// ChArUco boards drawn by OpenCV, seen through known homographies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/board/observe_board.h"
#include "calib/observations.h"
#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;

Target charuco() {
  Target target{TargetType::kCharuco, 8, 6, 12, 12};
  target.marker_mm = 8.5;
  target.dictionary = "DICT_5X5_100";
  return target;
}

/// A picture of the board and where its corners are in it.
struct Drawn {
  cv::Mat1b gray;
  std::vector<Vector2d> corners;
};

Drawn drawn(const Target& target, const cv::Matx33d& pixel_from_board_px, cv::Size size) {
  constexpr int kPxPerMm = 8;
  const auto board = cv::aruco::CharucoBoard::create(
      target.columns + 1, target.rows + 1, static_cast<float>(target.pitch_x),
      static_cast<float>(target.marker_mm), cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_100));
  const int side = static_cast<int>(target.pitch_x) * kPxPerMm;
  cv::Mat flat;
  board->draw(cv::Size((target.columns + 1) * side, (target.rows + 1) * side), flat, 0, 1);
  Drawn result;
  cv::GaussianBlur(flat, flat, {}, 3);  // half of a pixel's width in the picture
  cv::warpPerspective(flat, result.gray, pixel_from_board_px, size, cv::INTER_AREA, cv::BORDER_CONSTANT, 255);
  result.gray.convertTo(result.gray, CV_8U, 0.6, 40);
  for (int i = 0; i < target.num_corners(); ++i) {
    // The first inner corner lies a square inside; edges of squares lie between pixels.
    const Vector2d p = kPxPerMm * (target.corner(i) + Vector2d(target.pitch_x, target.pitch_y));
    const cv::Vec3d q = pixel_from_board_px * cv::Vec3d(p.x() - 0.5, p.y() - 0.5, 1);
    result.corners.emplace_back(q[0] / q[2], q[1] / q[2]);
  }
  return result;
}

ImageView8 view_of(const cv::Mat1b& gray) {
  return {gray.data, gray.cols, gray.rows, static_cast<int>(gray.step)};
}

const cv::Matx33d kOblique(0.62, 0.06, 90, -0.03, 0.60, 80, 2e-5, 6e-5, 1);

TEST(Charuco, AllCornersAreFoundInTheirOrder) {
  const auto picture = drawn(charuco(), kOblique, {800, 600});
  const auto detection = detect_board(view_of(picture.gray), charuco());
  ASSERT_TRUE(detection.found) << detection.reason;
  ASSERT_EQ(detection.corners.size(), 48u);
  for (std::size_t i = 0; i < 48; ++i) {
    ASSERT_TRUE(is_seen(detection.corners[i])) << i;
    EXPECT_LT((detection.corners[i] - picture.corners[i]).norm(), 0.15)
        << i;  // of a warped, undithered picture
  }
}

TEST(Charuco, APartOfTheBoardGivesItsCorners) {
  const cv::Matx33d shift(1, 0, -330, 0, 1, -120, 0, 0, 1);
  const auto picture = drawn(charuco(), shift * kOblique, {520, 420});
  const auto detection = detect_board(view_of(picture.gray), charuco());
  ASSERT_TRUE(detection.found) << detection.reason;
  int seen = 0;
  for (std::size_t i = 0; i < 48; ++i) {
    if (!is_seen(detection.corners[i])) continue;
    ++seen;
    EXPECT_LT((detection.corners[i] - picture.corners[i]).norm(), 0.15) << i;
  }
  EXPECT_GE(seen, 8);
  EXPECT_LT(seen, 48);
}

TEST(Charuco, ATurnedBoardKeepsItsOrder) {
  // Half a turn about the middle of the picture: the markers tell.
  const cv::Matx33d half_turn(-1, 0, 799, 0, -1, 599, 0, 0, 1);
  const auto picture = drawn(charuco(), half_turn * kOblique, {800, 600});
  const auto detection = detect_board(view_of(picture.gray), charuco());
  ASSERT_TRUE(detection.found) << detection.reason;
  for (std::size_t i = 0; i < 48; ++i)
    if (is_seen(detection.corners[i])) {
      EXPECT_LT((detection.corners[i] - picture.corners[i]).norm(), 0.15) << i;
    }
}

TEST(Charuco, TooLittleOfItIsRefusedWithTheCount) {
  const cv::Matx33d shift(1, 0, -560, 0, 1, -420, 0, 0, 1);
  const auto picture = drawn(charuco(), shift * kOblique, {260, 200});
  const auto detection = detect_board(view_of(picture.gray), charuco());
  EXPECT_FALSE(detection.found);
  EXPECT_FALSE(detection.reason.empty());
}

TEST(Charuco, AnUnknownDictionaryIsNamed) {
  auto target = charuco();
  target.dictionary = "DICT_9X9_7";
  const auto picture = drawn(charuco(), kOblique, {800, 600});
  EXPECT_THROW(detect_board(view_of(picture.gray), target), Error);
}

TEST(Charuco, StripePointsOnMarkersAreLeftOut) {
  // A straight upright line over the board; the dark squares alternate along it. Without the plain rim, which
  // carries stripes too.
  const auto picture = drawn(charuco(), kOblique, {800, 600});
  auto target = charuco();
  target.rim_mm = 0;
  const auto detection = detect_board(view_of(picture.gray), target);
  ASSERT_TRUE(detection.found) << detection.reason;
  Stripe stripe;
  for (double y = 60; y < 560; y += 1)
    stripe.points.push_back({.x = 400, .y = y, .normal_x = 1, .width = 3, .sigma_px = 0.05});
  const auto on_board = select_stripes({stripe}, detection.corners, target, 1);
  ASSERT_EQ(on_board.planes.size(), 1u) << on_board.reason;
  EXPECT_GT(on_board.planes[0].size(), 50u);
  for (const auto& point : on_board.planes[0])
    EXPECT_LT(picture.gray(static_cast<int>(point.y), 400), 100) << point.y;  // black is 40, white 193
}

}  // namespace
}  // namespace lightstripe
