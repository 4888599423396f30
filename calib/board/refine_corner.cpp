// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/refine_corner.h"

#include <opencv2/imgproc.hpp>
#include <vector>

namespace lightstripe {

Eigen::Vector2d refined_corner(const cv::Mat& gray, const Eigen::Vector2d& corner, int half_window) {
  std::vector<cv::Point2f> point{cv::Point2f(static_cast<float>(corner.x()), static_cast<float>(corner.y()))};
  cv::cornerSubPix(gray, point, cv::Size(half_window, half_window), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-4));
  return {point[0].x, point[0].y};
}

}  // namespace lightstripe
