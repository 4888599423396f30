// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Equivalent conicity of a reference wheelset on both rails of one measured section.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "measure/conicity.h"
#include "measure/track_gauge.h"

namespace lightstripe {

/// The wheels that the track is judged by. The options' gauge and its sigma are not looked at.
struct ReferenceWheelset {
  std::array<RollingProfile, kSides> wheels;  ///< left, right
  ConicityOptions options;
};

/// A rail's head over the running plane: points (y, z) in order from the gauge face outwards, y from the
/// gauge point towards the field, z from the crest upwards, mm.
struct RailHead {
  std::string reason;  ///< empty: known
  std::vector<Eigen::Vector2d> points;
  /// Variance of a point here over that of a measured one: it is a mean, and two sensors that see the same
  /// place err on their own.
  double variance_share = 1;
};

/// Means of the points over kRailPointMm each, down to the gauge point's depth on both sides; single points
/// that lie off their neighbours do not count. Unknown where fewer than thirty are left or a hole of more
/// than 5 mm lies where wheels roll.
RailHead rail_head_of(const PlacedSection& rail, const TrackPlane& track, TrackSide side, double depth_mm);
inline constexpr double kRailPointMm = 0.5;

/// Not usable, with the reason, where gauge or a head is not known.
Conicity conicity_of_track(const PlacedSection& left, const PlacedSection& right, const TrackPlane& track,
                           const ReferenceWheelset& wheelset, const RailOptions& options);

}  // namespace lightstripe
