// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a rail's measurement that look at the whole head.
#pragma once

#include "measure/estimate.h"
#include "measure/surface_fit.h"

namespace lightstripe {

/// The highest point of the measured head on the reference, in coordinates across and along `up` (unit;
/// upright: those of the reference).
struct HeadTop {
  std::string reason;  ///< empty: known
  double u = 0, v = 0;
};
HeadTop find_head_top(const PlacedSection& placed, const Eigen::Vector2d& up = Eigen::Vector2d::UnitY());

/// A head face where a ray from `origin` along `outwards` (nearly level) meets it. At the gauge point the
/// stripe begins to bend into the corner, and sharp bends are seen a hundredth of a millimetre too far
/// inside; so the straight face below is carried up, unless what is seen at the height itself contradicts it.
SurfaceFit fit_head_face(const PlacedSection& placed, const Eigen::Vector2d& origin,
                         const Eigen::Vector2d& outwards);

/// Area between reference and measured head above the lower ends of the head's faces, mm2, by polar sectors
/// about a point inside the head. Unknown where the section has a hole of more than eight sectors of 1 deg.
Estimate head_area_loss(const PlacedSection& placed);

/// Farthest that metal stands out of the reference's face on this side (+1: u > 0), between the running
/// surface and somewhat below the face. Zero if less than `lip_mm`.
Estimate find_lip(const PlacedSection& placed, int side, double lip_mm);

}  // namespace lightstripe
