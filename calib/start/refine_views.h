// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Least squares over the corners of one camera's board views, for start values: the same bits in every run.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/board.h"
#include "core/camera.h"
#include "core/transform.h"

namespace lightstripe {

/// Brings the pose to the least sum of squared reprojection errors, px. The start has to lie in front of the
/// camera. False where that diverges; the pose is then unchanged.
bool refine_pose(const Camera& camera, const Target& target, const std::vector<Eigen::Vector2d>& corners,
                 Rigid3& cam_from_board);

/// The same over focal lengths, principal point, k1 k2 p1 p2 and all poses (Zhang 2000, section 3.2); the
/// other distortion terms stay.
bool refine_camera(Camera& camera, const Target& target,
                   const std::vector<const std::vector<Eigen::Vector2d>*>& corners,
                   std::vector<Rigid3>& cam_from_board);

}  // namespace lightstripe
