// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Laser planes to stripes by the part of the image that each plane reaches, and by order.
#pragma once

#include <vector>

#include "reconstruct/laser_lines.h"

namespace lightstripe {

/// See decide_laser_planes(); needs Sensor::depth_range_mm.
std::vector<LineDecision> assign_by_reach(const std::vector<Stripe>& stripes, const Sensor& sensor);

}  // namespace lightstripe
