// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Points across a stretch that shows no ridge of its own.
#pragma once

#include <optional>

#include "core/stripe.h"

namespace lightstripe {

/// The point at u in (0, 1) of the cubic that continues the directions of `a` and `b` (Hermite); a comes
/// before b along the line, normals are those of that sense. Flagged as bridged; width and strength lie
/// between theirs.
StripePoint bridged_point(const StripePoint& a, const StripePoint& b, double u);

/// Whether a and b can be joined by a curve that turns by less than about 20 degrees on either side.
bool can_bridge(const StripePoint& a, const StripePoint& b);

}  // namespace lightstripe
