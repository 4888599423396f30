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
  double travel = 0;                       ///< mm or degrees
  std::optional<Rigid3> world_from_rig{};  ///< where poses are known: the points lie in that world
  bool interpolated = false;               ///< the travel lies between two readings, it was not read itself
};

/// From the rig frame at the moment of the picture to the frame of the result (the rig frame at travel 0, or
/// the poses' world), s = travel, x = motion.direction (the rig's x):
///   linear, rig moves: p + s x           linear, object moves: p - s x
///   rotary, rig moves: turned by +s      rotary, object moves: turned back by s, about axis_direction (right
///   hand)
/// The sign of a rotary travel is thus that of what moves: the object (or the rig) has turned by +s since
/// travel 0. A rig without a calibrated motion travels along its x.
Rigid3 result_from_rig(const Motion& motion, const FramePosition& position);

/// Adds to what is there of the same sensor.
void add_outside_range(const OutsideRange& more, std::vector<OutsideRange>& all);

/// Appends the points of one sensor's stripes to the profile, put right for the sheet's thickness
/// (sheet_middle.h). Stripe points whose ray cannot be undistorted or misses the plane, and those of a line
/// without a laser plane (decide_laser_planes), are counted in Profile::num_missed, those that may lie
/// outside the depth range in Profile::outside as well.
///
/// u, v: y, z of the result (linear); y, z of the rig frame (poses); position along the axis and radius
/// (rotary). sigma_mm: the stripe's sigma_px carried through lens and plane, its part square to the section
/// (an error along the section moves a point onto its neighbour and is none), in quadrature with
/// quality.section_shape_sigma_mm.
void triangulate_stripes(const std::vector<Stripe>& stripes, const Rig& rig, int sensor,
                         const FramePosition& position, Profile& profile);

}  // namespace lightstripe
