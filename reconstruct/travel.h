// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// An encoder's readings -> the travel of every frame between them.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/rig.h"
#include "reconstruct/triangulate.h"

namespace lightstripe {

/// Readings of an encoder: frame and travel (mm or degrees), frames ascending.
using TravelReadings = std::vector<std::pair<std::int64_t, double>>;

/// The travel of a frame. Where it has no reading, its neighbours' are interpolated in proportion to the
/// frames, and the position says so. Nothing before the first and behind the last reading: there a travel
/// would be made up. Nothing either where a rotary motion's neighbours are more than half a turn apart: an
/// encoder that began anew at a full turn would look the same.
std::optional<FramePosition> position_at(const TravelReadings& readings, MotionType motion,
                                         std::int64_t frame);

}  // namespace lightstripe
