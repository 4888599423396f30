// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Points between two evaluated ones. The kernels leave nothing in the picture that is finer than their sigma,
// so that a wide stripe need not be evaluated in every column.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/stripe.h"
#include "extraction/follow/direction_guided_ridge.h"

namespace lightstripe {

/// Columns (rows) from one evaluation to the next: sigma, and up to 4/3 sigma from 3 px on. Place and
/// direction of both ends fix a cubic that is off by h^4 / 384 times the fourth derivative; of noise that was
/// smoothed over sigma that is 2.6 / sigma^4 of itself: 2 %. Of narrow stripes the gaps and ragged ends are
/// only a few pixels long.
inline int evaluation_stride(double sigma) {
  return std::clamp(static_cast<int>(sigma < 3 ? sigma : 1.334 * sigma), 1, 4);
}

/// Appends the `steps` - 1 points between a and b, which lie `steps` columns (rows) apart: a cubic through
/// both with their directions.
void append_between(const RidgePlace& a, const RidgePlace& b, int steps, std::vector<StripePoint>& out);

/// Points of a line that was followed in an image of 2^shift x 2^shift means, as points of the image itself:
/// again one a column (row), by the same cubic.
void append_in_full_image(std::span<const StripePoint> binned, int shift, std::vector<StripePoint>& out);

}  // namespace lightstripe
