// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/refine_corner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace lightstripe {
namespace {

/// Two dark and two light squares that meet at `corner`, turned by 20 degrees, blurred by 0.8 px.
cv::Mat four_squares(const Eigen::Vector2d& corner) {
  const Eigen::Vector2d along(std::cos(0.35), std::sin(0.35));
  cv::Mat gray(60, 80, CV_8UC1);
  for (int y = 0; y < gray.rows; ++y)
    for (int x = 0; x < gray.cols; ++x) {
      const Eigen::Vector2d from = Eigen::Vector2d(x, y) - corner;
      const auto side = [](double distance) { return std::erf(distance / (0.8 * std::sqrt(2.0))); };
      const double u = side(from.dot(along)), v = side(along.x() * from.y() - along.y() * from.x());
      gray.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::lround(120 + 80 * u * v));
    }
  return gray;
}

TEST(RefineCorner, FindsWhereSquaresMeet) {
  for (const double phase : {0.0, 0.25, 0.5, 0.8}) {
    const Eigen::Vector2d corner(40 + phase, 30 - 0.7 * phase);
    const Eigen::Vector2d found = refined_corner(four_squares(corner), corner + Eigen::Vector2d(1.5, -1), 6);
    // cv::cornerSubPix is good to 0.03 px on slanted corners; the search begins 1.8 px away.
    EXPECT_LT((found - corner).norm(), 0.05) << phase;
  }
}

}  // namespace
}  // namespace lightstripe
