// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The projective map from a flat board to an image and the pose that follows from it, as start values. Own
// code instead of OpenCV's: that one calls the machine's BLAS, whose last bits depend on where in memory the
// matrices happen to lie, so that two runs over the same pictures would end in different rigs.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/transform.h"

namespace lightstripe {

/// `to` ~ H (`from`, 1): the direct linear transform on normalised coordinates (Hartley, Zisserman: Multiple
/// View Geometry, algorithm 4.2). Nothing for fewer than 4 points, or points on one line.
std::optional<Eigen::Matrix3d> find_homography(std::span<const Eigen::Vector2d> from,
                                               std::span<const Eigen::Vector2d> to);

/// The pose of a board from the homography to its rays (x, y, 1) (Zhang 2000, section 3.1). `seen`: a place
/// of the board that lies before the camera. Its origin need not: of a long board only one end may be in
/// view.
Rigid3 pose_from_homography(const Eigen::Matrix3d& rays_from_board, const Eigen::Vector2d& seen);

}  // namespace lightstripe
