// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/kernels_recursive.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "extraction/kernels/kernels_recursive.cpp"
// Highway compiles this file once for each instruction set.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightstripe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void recursive_row(const RowPointers& inputs, const RowPointers& past, const RecursiveWeights& weights,
                   float* out, std::size_t count) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t x = 0;
  for (; x + lanes <= count; x += lanes) {
    auto sum = hn::Mul(hn::LoadU(d, inputs[0] + x), hn::Set(d, weights.input[0]));
    for (std::size_t k = 1; k < kRecursiveOrder; ++k)
      sum = hn::MulAdd(hn::LoadU(d, inputs[k] + x), hn::Set(d, weights.input[k]), sum);
    for (std::size_t k = 0; k < kRecursiveOrder; ++k)
      sum = hn::NegMulAdd(hn::LoadU(d, past[k] + x), hn::Set(d, weights.past[k]), sum);
    hn::StoreU(sum, d, out + x);
  }
  if (x == count) return;
  const RowPointers in_rest{inputs[0] + x, inputs[1] + x, inputs[2] + x, inputs[3] + x};
  const RowPointers past_rest{past[0] + x, past[1] + x, past[2] + x, past[3] + x};
  filter_row_recursively_scalar(in_rest, past_rest, weights, out + x, count - x);
}

}  // namespace HWY_NAMESPACE
}  // namespace lightstripe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightstripe {

HWY_EXPORT(recursive_row);

void filter_row_recursively(const RowPointers& inputs, const RowPointers& past,
                            const RecursiveWeights& weights, float* out, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(recursive_row)(inputs, past, weights, out, count);
}

}  // namespace lightstripe
#endif  // HWY_ONCE
