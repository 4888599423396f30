// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Across a projected stripe: the constants of StripeResidual, taken from the model instead of the
// extraction's normals, which are noisier.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/camera.h"
#include "core/plane.h"

namespace lightstripe {

struct StripeCrossing {
  Eigen::Vector2d
      normal;  ///< unit, px: across the projection of the line "board meets laser plane", next to the pixel
  Eigen::Vector3d across;  ///< unit normal of the plane through the projection centre that the rays of pixel
                           ///< +- normal span
  double distance_px = 0;  ///< from the pixel to the projected line, along `normal`
};

/// Nothing where board and laser plane are parallel, or the pixel or the line cannot be seen.
std::optional<StripeCrossing> stripe_crossing(const Camera& camera, const Plane& board, const Plane& laser,
                                              const Eigen::Vector2d& pixel);

}  // namespace lightstripe
