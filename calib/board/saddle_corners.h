// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where two dark and two light squares meet: saddle points of the smoothed image with their edge directions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace lightstripe {

struct SaddleCorner {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< px, to about a pixel
  /// Unit vectors along the two edges, counted with growing angle (x to y); the sector from edges[0] to
  /// edges[1] is dark, from edges[1] to -edges[0] it is light. Neighbours on a board have them the other way
  /// round.
  std::array<Eigen::Vector2d, 2> edges{};
};

/// At most 3000 corners, strongest first, whose surroundings are point-symmetric with two dark and two light
/// sectors.
std::vector<SaddleCorner> find_saddle_corners(const cv::Mat& gray);

}  // namespace lightstripe
