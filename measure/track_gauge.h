// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Two rails in one section: told apart, and the gauge between them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/profile.h"
#include "measure/measure_rail.h"
#include "measure/surface_fit.h"

namespace lightstripe {

/// u in the middle of the widest hole between the points of all sections; nothing where that is narrower than
/// 300 mm, which is no track.
std::optional<double> place_between_rails(const std::vector<Profile>& profiles);

/// The points of a section on either side of `between_u`.
struct RailPair {
  Profile left, right;  ///< left: +u
};
RailPair split_rails(const Profile& profile, double between_u);

/// How a track lies in its section; section coordinates, by side: left, right.
struct TrackPlane {
  Estimate gauge;                                         ///< unknown: nothing else is known either
  Eigen::Vector2d across = Eigen::Vector2d::UnitX();      ///< unit, along the running plane to the left rail
  std::array<Eigen::Vector2d, 2> crest{}, gauge_point{};  ///< highest points over the plane, and on the faces
};

/// The running plane is the line through both heads' highest points, whatever the cant. The rest as
/// track_gauge().
TrackPlane find_track_plane(const PlacedSection& left, const PlacedSection& right, const RailOptions& options,
                            std::optional<double> rig_sigma_mm);

/// Distance between the two gauge faces along the running plane (the line through both heads' highest points,
/// whatever the cant), `options.gauge_point_mm` below it; where metal stands out of a face farther up by more
/// than `options.lip_mm`, from there: EN 13848-1 looks for the nearest points between the top and that depth.
/// Both sections lie in the same frame, as measured. `rig_sigma_mm`: how well the rig knows where its sensors
/// stand, 1-sigma of each rail's place; without it the gauge has no sigma.
Estimate track_gauge(const PlacedSection& left, const PlacedSection& right, const RailOptions& options,
                     std::optional<double> rig_sigma_mm);

}  // namespace lightstripe
