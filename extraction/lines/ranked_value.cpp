// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/ranked_value.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

constexpr std::size_t kMost = 512;
using Values = std::array<float, kMost>;

float median_of_three(float a, float b, float c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// How many values are less, and how many greater than the pivot; these are written apart.
struct Parts {
  std::size_t less = 0, greater = 0;
};
Parts part(std::span<const float> values, float pivot, Values& less, Values& greater) {
  Parts parts;
  for (const float value : values) {
    // Written in any case, kept where the place behind it moves on.
    less[parts.less] = value;
    parts.less += value < pivot ? 1U : 0U;
    greater[parts.greater] = value;
    parts.greater += value > pivot ? 1U : 0U;
  }
  return parts;
}

}  // namespace

float ranked_value(std::span<float> values, std::size_t rank) {
  LIGHTSTRIPE_CHECK(rank < values.size(), "a rank beyond the values");
  // One place more than values, since what is not kept is written, too.
  if (values.size() >= kMost) return value_at_rank(values, rank);
  std::array<Values, 4> memory;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  for (std::size_t turn = 0;; turn ^= 1U) {
    const float pivot = median_of_three(values.front(), values[values.size() / 2], values.back());
    Values &less = memory[2 * turn], &greater = memory[2 * turn + 1];
    const Parts parts = part(values, pivot, less, greater);
    const std::size_t equal = values.size() - parts.less - parts.greater;
    if (rank < parts.less) {
      values = std::span(less).first(parts.less);
    } else if (rank < parts.less + equal) {
      return pivot;
    } else {
      rank -= parts.less + equal;
      values = std::span(greater).first(parts.greater);
    }
  }
}

}  // namespace lightstripe
