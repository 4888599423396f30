// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where the laser's line lies in an image, by geometry alone: no pixels, no brightness profile.
#pragma once

#include <vector>

#include "simulate/optics.h"
#include "simulate/scene.h"
#include "simulate/surfaces.h"

namespace lightstripe {

/// A point of the sheet's middle on a surface: lit (nothing between it and the source) and visible.
struct StripeTruth {
  Eigen::Vector2d pixel;     ///< by the camera model
  Eigen::Vector3d position;  ///< mm, world
  double level = 0;          ///< grey levels that the laser adds there before blur
};

/// Traces rays of the fan from the source to the first surface, keeps what the camera sees within its image,
/// in order along the fan, about `spacing_px` apart (farther only where a step of the fan's angle jumps from
/// surface to surface).
std::vector<StripeTruth> trace_stripe(const World& world, const View& view, const Imaging& imaging,
                                      double spacing_px = 0.5);

}  // namespace lightstripe
