// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A corner of a board to a few hundredths of a pixel.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace lightstripe {

/// Where the edges within `half_window` px of the corner meet (cv::cornerSubPix); no other corner may lie
/// within them.
Eigen::Vector2d refined_corner(const cv::Mat& gray, const Eigen::Vector2d& corner, int half_window);

}  // namespace lightstripe
