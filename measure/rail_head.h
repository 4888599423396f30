// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a rail's measurement that look at the whole head.
#pragma once

#include "measure/estimate.h"
#include "measure/surface_fit.h"

namespace lightstripe {

/// Height of the highest point of the measured head on the reference.
struct HeadTop {
  std::string reason;  ///< empty: known
  double u = 0, v = 0;
};
HeadTop find_head_top(const PlacedSection& placed);

/// Area between reference and measured head above the lower ends of the head's faces, mm2, by polar sectors
/// about a point inside the head. Unknown where the section has a hole of more than two sectors.
Estimate head_area_loss(const PlacedSection& placed);

/// Farthest that metal stands out of the reference's face on this side (+1: u > 0), between the running
/// surface and somewhat below the face. Zero if less than `lip_mm`.
Estimate find_lip(const PlacedSection& placed, int side, double lip_mm);

}  // namespace lightstripe
