// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A ChArUco board's corners: markers between the squares say which corner is which, so that a part of the
// board is enough.
#pragma once

#include <opencv2/core/mat.hpp>

#include "calib/board/observe_board.h"

namespace lightstripe {

/// Corners in the order of Target::corner (that of OpenCV's CharucoBoard), those out of view unseen_corner().
/// Not found with fewer than 8 corners, or corners on one line; an Error for a dictionary that OpenCV does
/// not know.
BoardDetection detect_charuco(const cv::Mat& gray, const Target& target);

}  // namespace lightstripe
