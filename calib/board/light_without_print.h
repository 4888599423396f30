// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One picture with board and laser -> the laser's light alone, where no second picture without laser exists:
// the print is predicted from the corners and from the level of each square.
#pragma once

#include <optional>

#include "calib/board/board_map.h"
#include "core/board.h"
#include "core/image.h"

namespace lightstripe {

/// kDarkLevel + image - predicted print on the board and its rim, clipped to 0..255; elsewhere noise of the
/// board's own strength about kDarkLevel, so that thresholds see the board only. A square's level is its
/// median, which a stripe that covers less than half of it does not move; the edges' blur is the one that
/// fits best. Nothing for other targets than checkerboards, and for squares below 6 px. `map`: of the
/// picture's corners.
std::optional<Image8> light_without_print(ImageView8 image, const BoardMap& map, const Target& target);

}  // namespace lightstripe
