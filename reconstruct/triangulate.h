// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// stripes + rig -> points: undistort, meet the laser plane, apply the travel.
#pragma once

#include <optional>
#include <vector>

#include "core/profile.h"
#include "core/rig.h"
#include "core/stripe.h"

namespace lightstripe {

/// Where the rig stood in this frame: a travel along (or about) the rig's motion, or a pose world_from_rig.
struct FramePosition {
  double travel = 0;                     ///< mm or degrees
  std::optional<Rigid3> world_from_rig;  ///< where poses are known: the points lie in that world
};

/// Appends the points of one sensor's stripes to the profile. Rays that cannot be undistorted or miss the plane are
/// counted in Profile::num_missed.
void triangulate_stripes(const std::vector<Stripe>& stripes, const Rig& rig, int sensor, const FramePosition& position,
                         Profile& profile);

}  // namespace lightstripe
