// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where a section may lie on the reference, before anything is fitted: many poses tried on a distance map.
#pragma once

#include <vector>

#include "core/section_move.h"
#include "measure/reference_shape.h"

namespace lightstripe {

/// A section's pose on the reference: first u changes its sign (if mirrored), then the move.
struct SectionPose {
  bool mirrored = false;
  SectionMove move;

  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    return move * (mirrored ? Eigen::Vector2d(-p.x(), p.y()) : p);
  }
};

struct CoarsePoseOptions {
  double max_tilt_deg = 9;  ///< how far the section may be turned against the reference
  bool may_mirror = false;  ///< also tries u -> -u (a wheel seen from the other side)
  bool may_be_upside_down = false;
  int candidates = 3;  ///< how many poses are handed on
};

/// The best poses, best first, apart from each other. The cost is the sum of min(d, 5)^2 over some fifty
/// points. Needs three points.
std::vector<SectionPose> coarse_poses(const Section& section, const ReferenceShape& reference,
                                      const CoarsePoseOptions& options);

}  // namespace lightstripe
