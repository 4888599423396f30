// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which laser plane lit which stripe, for sensors that see several.
#pragma once

#include <optional>
#include <vector>

#include "core/rig.h"
#include "core/stripe.h"

namespace lightstripe {

/// The laser plane (index into Sensor::laser_planes) of each stripe; nothing where it is ambiguous, because a
/// guess would be a wrong depth. One plane: all stripes are its own.
///
/// With a known Sensor::depth_range_mm: a plane may own a stripe only where the stripe lies in the part of
/// the image that the plane can reach within that range; of stripes beside each other the order is that of
/// the planes in the image (of lines that cross: at both ends), and no two of them share a plane (the pieces
/// of a broken stripe do, one after the other along it). A stripe gets the plane that is the same in every
/// assignment which holds to that.
///
/// Without: stripes and planes are put in order along the direction in which the planes follow each other in
/// the picture, and paired, if there are as many of both.
std::vector<std::optional<int>> assign_laser_planes(const std::vector<Stripe>& stripes, const Sensor& sensor);

}  // namespace lightstripe
