// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Straight lines in a picture of the laser on blocks: the candidates for the light on a block's top.
#pragma once

#include <vector>

#include "core/stripe.h"

namespace lightstripe {

/// The stripes' points as straight lines of at least 20 points, the longest first, at most six. A block on a
/// bed breaks the laser's line: its top, and the bed on both sides, are lines of their own.
std::vector<std::vector<StripePoint>> straight_lines(const std::vector<Stripe>& stripes);

}  // namespace lightstripe
