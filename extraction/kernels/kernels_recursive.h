// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One row of a recursive filter that runs across the rows: each output row from four input rows and four
// earlier output rows.
#pragma once

#include <array>
#include <cstddef>

namespace lightstripe {

inline constexpr std::size_t kRecursiveOrder = 4;
using RowPointers = std::array<const float*, kRecursiveOrder>;

struct RecursiveWeights {
  std::array<float, kRecursiveOrder> input{};  ///< of the input rows
  std::array<float, kRecursiveOrder> past{};   ///< of the output rows before, subtracted
};

/// out[x] = sum_k weights.input[k] inputs[k][x] - sum_k weights.past[k] past[k][x]. `out` may be none of the
/// others.
void filter_row_recursively(const RowPointers& inputs, const RowPointers& past,
                            const RecursiveWeights& weights, float* out, std::size_t count);

/// The plain reference.
inline void filter_row_recursively_scalar(const RowPointers& inputs, const RowPointers& past,
                                          const RecursiveWeights& weights, float* out, std::size_t count) {
  for (std::size_t x = 0; x < count; ++x) {
    double sum = 0;
    for (std::size_t k = 0; k < kRecursiveOrder; ++k)
      sum += double{weights.input[k]} * double{inputs[k][x]} - double{weights.past[k]} * double{past[k][x]};
    out[x] = static_cast<float>(sum);
  }
}

}  // namespace lightstripe
