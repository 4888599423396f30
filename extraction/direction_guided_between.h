// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Points between two evaluated ones. The kernels leave nothing in the picture that is finer than their sigma,
// so that a wide stripe need not be evaluated in every column.
#pragma once

#include <vector>

#include "core/stripe.h"
#include "extraction/direction_guided_ridge.h"

namespace lightstripe {

/// Appends the `steps` - 1 points between a and b, which lie `steps` columns (rows) apart: a cubic through
/// both with their directions.
void append_between(const RidgePlace& a, const RidgePlace& b, int steps, std::vector<StripePoint>& out);

}  // namespace lightstripe
