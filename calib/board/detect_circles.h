// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Circle grids and grids of AprilTags.
#pragma once

#include <opencv2/core/mat.hpp>

#include "calib/board/observe_board.h"

namespace lightstripe {

/// Circles in OpenCV's order (cv::findCirclesGrid), dark on light or light on dark; their middles are the
/// centres of gravity of the printed discs as the picture shows them, which perspective and distortion shift
/// against the discs' middles: see correct_circles().
BoardDetection detect_circles(const cv::Mat& gray, const Target& target);

/// Kalibr's AprilGrid of the family 36h11: tag 0 at the lower left, tag numbers growing to the right and then
/// upwards; parts of the board are enough. Corners refined by cv::cornerSubPix between a tag and the black
/// squares that touch it.
BoardDetection detect_aprilgrid(const cv::Mat& gray, const Target& target);

}  // namespace lightstripe
