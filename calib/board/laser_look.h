// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether a line on a board looks like a laser's, where no second picture without laser can tell.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/board/board_map.h"
#include "core/board.h"
#include "core/image.h"
#include "core/stripe.h"

namespace lightstripe {

/// Empty where the line looks like a laser's; otherwise what it looks like. A laser is brighter than the
/// print that it falls on: a line that is as bright as the board's own light squares, or that runs along the
/// pattern's border between dark print and a darker ground, is print. `map`: of these corners.
std::string no_laser_because(ImageView8 image, const std::vector<StripePoint>& line,
                             const std::vector<Eigen::Vector2d>& corners, const BoardMap& map,
                             const Target& target);

}  // namespace lightstripe
