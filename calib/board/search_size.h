// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Boards are searched in a picture of moderate size: that is quick, and noise is averaged.
#pragma once

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "calib/observations.h"

namespace lightstripe {

/// 1, 2, 4 ...: the smallest that brings the picture down to 1600 pixels in width and height.
inline int search_factor(const cv::Mat& gray) {
  constexpr int kMaxSearchSizePx = 1600;
  int factor = 1;
  while (std::max(gray.cols, gray.rows) / factor > kMaxSearchSizePx) factor *= 2;
  return factor;
}

/// The picture at 1 / factor of its size; itself where that is 1.
inline cv::Mat shrunk(const cv::Mat& gray, int factor) {
  cv::Mat small;
  if (factor > 1) cv::resize(gray, small, {}, 1.0 / factor, 1.0 / factor, cv::INTER_AREA);
  return factor > 1 ? small : gray;
}

/// Corners of the shrunk picture in pixels of the full one (pixel centres are integers).
inline std::vector<Eigen::Vector2d> enlarged(std::vector<Eigen::Vector2d> corners, int factor) {
  for (auto& corner : corners) corner = (corner.array() + 0.5) * factor - 0.5;
  return corners;
}

}  // namespace lightstripe
