// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which laser plane lit which stripe, for sensors that see several.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/rig.h"
#include "core/stripe.h"

namespace lightstripe {

/// What is certain about one stripe.
struct LineDecision {
  std::optional<int> plane;      ///< index into Sensor::laser_planes; nothing: a guess would be a wrong depth
  bool may_lie_outside = false;  ///< dropped because it may lie outside Sensor::depth_range_mm
  std::optional<std::array<double, 2>>
      outside_mm{};  ///< where it lies outside for certain: nearest, farthest
};

/// The laser plane of each stripe. One plane: all stripes are its own.
///
/// With a known Sensor::depth_range_mm each stripe is decided for itself. Of stripes beside each other the
/// order is that of the planes in the image (of lines that cross: at both ends), and no two of them share a
/// plane (the pieces of a broken stripe do, one after the other along it); where that cannot be, the fewest
/// possible are taken for stray light. A stripe gets the plane that is the same in every assignment which
/// holds to that with depths within the range, or near it. Where no assignment does without depths far from
/// the range, or other lines of the picture prove by their order that they lie outside, depths from half the
/// nearest to twice the farthest are thought of. A stripe that then lies, or may lie, outside is dropped.
///
/// Without: stripes and planes are put in order along the direction in which the planes follow each other in
/// the picture, and paired, if there are as many of both.
std::vector<LineDecision> decide_laser_planes(const std::vector<Stripe>& stripes, const Sensor& sensor);

/// The planes of decide_laser_planes() alone.
std::vector<std::optional<int>> assign_laser_planes(const std::vector<Stripe>& stripes, const Sensor& sensor);

}  // namespace lightstripe
