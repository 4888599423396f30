// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether the board stood still between the two pictures of a pair.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/board.h"
#include "core/image.h"

namespace lightstripe {

/// How far the board moved between the picture without laser (where its corners are known) and that with it,
/// px: the median over the corners. Nothing where the second picture shows the board too faintly to tell.
std::optional<double> board_shift_px(ImageView8 laser, ImageView8 board,
                                     const std::vector<Eigen::Vector2d>& corners, const Target& target);

}  // namespace lightstripe
