// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which laser plane lit which stripe, for sensors that see several.
#pragma once

#include <optional>
#include <vector>

#include "core/rig.h"
#include "core/stripe.h"

namespace lightstripe {

/// The laser plane (index into Sensor::laser_planes) of each stripe. One plane: all stripes are its own.
/// Several planes: stripes and planes are put in order along the direction in which the planes follow each
/// other in the picture, and paired. That holds where each plane gives one unbroken stripe; nothing is
/// returned where the counts differ (a stripe broken in two, one not lit) or the planes have no common order,
/// because a guess would be a wrong depth.
std::optional<std::vector<int>> assign_laser_planes(const std::vector<Stripe>& stripes, const Sensor& sensor);

}  // namespace lightstripe
