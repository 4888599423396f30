// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Line following: predict the next place, test it, and look aside or ahead only when the test fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/stripe.h"
#include "extraction/follow/direction_guided_ridge.h"
#include "extraction/follow/exclusion_mask.h"

namespace lightstripe {

/// The labels a line has in the mask: a new one every few steps, so that a line which comes back to its own
/// older part meets it like another line.
struct MaskLabels {
  std::uint16_t first = 0;    ///< of the line
  std::uint16_t current = 0;  ///< the last one given
};

/// Follows from `start` (not repeated in `out`) along its direction, or against it; appends points and marks
/// them in `mask`. `behind`: points that the line has on the start's other side. True if the line came back
/// to its start (a closed curve).
template <class T>
bool follow_one_way(const RidgeFinder<T>& finder, const RidgePlace& start, bool forward, std::size_t behind,
                    ExclusionMask& mask, MaskLabels& labels, std::vector<StripePoint>& out);

}  // namespace lightstripe
