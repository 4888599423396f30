// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether a grid of corners is what is printed: a whole board has squares beyond each side, and then none.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "calib/board/corner_grid.h"
#include "core/board.h"

namespace lightstripe {

/// Whether these linked corners are all that their board has, and not the target's number: nearly none is
/// missing, they fit a board that a lens shows, and the squares end beyond each side. A longer search for the
/// target in the same place is of no use then. `gray`: the picture in which the corners were found.
bool is_other_board(const cv::Mat& gray, const CornerGrid& grid, const Target& target);

/// Whether the board's last squares lie beyond each side of these corners (row by row, all seen). They do not
/// where the board has fewer corners than the target: the last row is then the outer edge of its squares.
bool has_squares_beyond(const cv::Mat& gray, const std::vector<Eigen::Vector2d>& corners,
                        const Target& target);

}  // namespace lightstripe
