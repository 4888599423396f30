// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Why a board was not found.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "calib/board/corner_grid.h"
#include "core/board.h"

namespace lightstripe {

/// One reason, the likeliest: too dark, no contrast, a board of another size, cut off, blurred (with the
/// edge's width), or simply not found. `grids`: what was seen instead.
std::string why_not_found(const cv::Mat& gray, const Target& target, const std::vector<CornerGrid>& grids);

/// The same for a grid of circles.
std::string why_no_circles(const cv::Mat& gray, const Target& target);

/// Distance from 10 to 90 % of a dark-light edge, px, by the steepest edges of the picture.
double edge_width_px(const cv::Mat& gray);

}  // namespace lightstripe
