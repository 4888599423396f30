// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The board's pose before a known camera.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/board.h"
#include "core/camera.h"
#include "core/transform.h"

namespace lightstripe {

/// cam_from_board by the corners' rays (least squares of their directions), so that any lens model serves;
/// nothing where fewer than four corners are seen and have a ray.
std::optional<Rigid3> board_pose(const Camera& camera, const Target& target,
                                 const std::vector<Eigen::Vector2d>& corners);

/// Root mean square length of the corners' residuals, px.
double corner_rms_px(const Camera& camera, const Target& target, const Rigid3& cam_from_board,
                     const std::vector<Eigen::Vector2d>& corners);

}  // namespace lightstripe
