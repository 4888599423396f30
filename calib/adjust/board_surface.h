// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A board that is not quite flat: z = warp.x (1 - u^2) + warp.y (1 - v^2), where u and v run from -1 to 1
// over the inner corners along x and y. warp.x is the bow along x in mm at the board's middle, warp.y that
// along y.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/board.h"
#include "core/camera.h"
#include "core/plane.h"
#include "core/transform.h"

namespace lightstripe {

/// A place on the board and how the warp moves it.
struct BoardPlace {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();       ///< mm, board frame
  Eigen::Vector2d weights = Eigen::Vector2d::Zero();  ///< z = weights . warp
  Eigen::Vector2d slopes =
      Eigen::Vector2d::Zero();  ///< dz/dx = slopes.x warp.x, dz/dy = slopes.y warp.y; 1/mm
  double z_mm = 0;              ///< of a plane parallel to the board, < 0 before it

  Eigen::Vector3d point(const Eigen::Vector2d& warp) const {
    return {xy.x(), xy.y(), z_mm + weights.dot(warp)};
  }
  /// Normal of the surface, not of unit length, z = 1.
  Eigen::Vector3d normal(const Eigen::Vector2d& warp) const {
    return {-slopes.x() * warp.x(), -slopes.y() * warp.y(), 1};
  }
};

BoardPlace board_place(const Target& target, const Eigen::Vector2d& xy);

/// Where a pixel's ray meets the board (taken as flat: the warp moves that place in the second order only).
std::optional<BoardPlace> seen_place(const Target& target, const Camera& camera, const Rigid3& cam_from_board,
                                     const Eigen::Vector2d& pixel);

/// The same on the flat top of a body that stands on the board, `height_mm` over it.
std::optional<BoardPlace> seen_place_on_top(const Camera& camera, const Rigid3& cam_from_board,
                                            double height_mm, const Eigen::Vector2d& pixel);

/// The plane `height_mm` over the board, as a board of its own.
Rigid3 raised(const Rigid3& cam_from_board, double height_mm);

/// The plane that touches the warped board at a place, camera frame.
Plane tangent_plane(const BoardPlace& place, const Eigen::Vector2d& warp, const Rigid3& cam_from_board);

}  // namespace lightstripe
