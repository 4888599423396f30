// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The corners that a view shows, in the picture and on the board.
#pragma once

#include <vector>

#include "calib/observations.h"
#include "core/board.h"

namespace lightstripe {

/// Two lists of one length.
struct SeenCorners {
  std::vector<Eigen::Vector2d> pixels;  ///< px
  std::vector<Eigen::Vector2d> board;   ///< mm, see Target::corner
};

/// `corners` in the order of Target::corner; unseen ones are left out.
inline SeenCorners seen_corners(const std::vector<Eigen::Vector2d>& corners, const Target& target) {
  SeenCorners seen;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!is_seen(corners[i])) continue;
    seen.pixels.push_back(corners[i]);
    seen.board.push_back(target.corner(static_cast<int>(i)));
  }
  return seen;
}

}  // namespace lightstripe
