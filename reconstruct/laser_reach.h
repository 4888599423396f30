// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Laser planes to stripes by the part of the image that each plane reaches, and by order.
#pragma once

#include <optional>
#include <vector>

#include "core/rig.h"
#include "core/stripe.h"

namespace lightstripe {

/// See assign_laser_planes(); needs Sensor::depth_range_mm.
std::vector<std::optional<int>> assign_by_reach(const std::vector<Stripe>& stripes, const Sensor& sensor);

}  // namespace lightstripe
