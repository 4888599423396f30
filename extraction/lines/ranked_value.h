// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Medians of the few hundred samples that tell what a line is like: there are a dozen of them a line.
#pragma once

#include <cstddef>
#include <span>

namespace lightstripe {

/// The value with this rank in rising order, 0 for the smallest; none of the values may be NaN. May reorder
/// the values. The same as value_at_rank(), and for fewer than 512 values faster: no branch depends on how a
/// value compares.
float ranked_value(std::span<float> values, std::size_t rank);

/// The median; of an even number the upper one of the two in the middle, 0 for none. May reorder the values.
inline float ranked_median(std::span<float> values) {
  return values.empty() ? 0.0F : ranked_value(values, values.size() / 2);
}

}  // namespace lightstripe
