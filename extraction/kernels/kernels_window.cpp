// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/kernels_window.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "extraction/kernels/kernels_window.cpp"
// Highway compiles this file once for each instruction set.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightstripe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Adds columns that were filtered along their length (by the smoothing kernel, the slope's, the curvature's)
/// to the six sums, lane by lane. `wx`: the columns' weights.
template <class D, class V>
HWY_INLINE void add_columns(D d, const float* wx, int pitch, V smooth, V slope, V curvature, V& value, V& dx,
                            V& dy, V& dxx, V& dxy, V& dyy) {
  const auto x0 = hn::LoadU(d, wx), x1 = hn::LoadU(d, wx + pitch), x2 = hn::LoadU(d, wx + 2 * pitch);
  value = hn::MulAdd(smooth, x0, value);
  dx = hn::MulAdd(smooth, x1, dx);
  dxx = hn::MulAdd(smooth, x2, dxx);
  dy = hn::MulAdd(slope, x0, dy);
  dxy = hn::MulAdd(slope, x1, dxy);
  dyy = hn::MulAdd(curvature, x0, dyy);
}

template <class T>
Derivatives window(const T* top_left, std::ptrdiff_t stride, const float* wx, const float* wy, int taps,
                   int pitch) {
  const hn::CappedTag<float, DerivativeKernels::kLanes> d;
  const hn::Rebind<T, decltype(d)> d_pixel;
  const hn::Rebind<std::int32_t, decltype(d)> d_int;
  const auto grey = [&](const T* p) { return hn::ConvertTo(d, hn::PromoteTo(d_int, hn::LoadU(d_pixel, p))); };
  const auto lanes = static_cast<int>(hn::Lanes(d));
  auto value = hn::Zero(d), dx = hn::Zero(d), dy = hn::Zero(d);
  auto dxx = hn::Zero(d), dxy = hn::Zero(d), dyy = hn::Zero(d);
  int i = 0;
  // Two vectors of columns at once: the sums of one would wait for each other.
  for (; i + lanes < taps; i += 2 * lanes) {
    auto smooth_a = hn::Zero(d), slope_a = hn::Zero(d), curvature_a = hn::Zero(d);
    auto smooth_b = hn::Zero(d), slope_b = hn::Zero(d), curvature_b = hn::Zero(d);
    const T* pixel = top_left + i;
    for (int j = 0; j < taps; ++j, pixel += stride) {
      const auto a = grey(pixel), b = grey(pixel + lanes);
      const auto y0 = hn::Set(d, wy[j]), y1 = hn::Set(d, wy[pitch + j]), y2 = hn::Set(d, wy[2 * pitch + j]);
      smooth_a = hn::MulAdd(a, y0, smooth_a);
      smooth_b = hn::MulAdd(b, y0, smooth_b);
      slope_a = hn::MulAdd(a, y1, slope_a);
      slope_b = hn::MulAdd(b, y1, slope_b);
      curvature_a = hn::MulAdd(a, y2, curvature_a);
      curvature_b = hn::MulAdd(b, y2, curvature_b);
    }
    add_columns(d, wx + i, pitch, smooth_a, slope_a, curvature_a, value, dx, dy, dxx, dxy, dyy);
    add_columns(d, wx + i + lanes, pitch, smooth_b, slope_b, curvature_b, value, dx, dy, dxx, dxy, dyy);
  }
  if (i < taps) {
    auto smooth = hn::Zero(d), slope = hn::Zero(d), curvature = hn::Zero(d);
    const T* pixel = top_left + i;
    for (int j = 0; j < taps; ++j, pixel += stride) {
      const auto a = grey(pixel);
      smooth = hn::MulAdd(a, hn::Set(d, wy[j]), smooth);
      slope = hn::MulAdd(a, hn::Set(d, wy[pitch + j]), slope);
      curvature = hn::MulAdd(a, hn::Set(d, wy[2 * pitch + j]), curvature);
    }
    add_columns(d, wx + i, pitch, smooth, slope, curvature, value, dx, dy, dxx, dxy, dyy);
  }
  const auto sum = [d](auto v) { return hn::GetLane(hn::SumOfLanes(d, v)); };
  return {sum(value), sum(dx), sum(dy), sum(dxx), sum(dxy), sum(dyy)};
}

/// Four sums, of each fourth pixel: few pixels do not fill longer vectors.
template <class T>
float row_sum(const T* pixels, std::ptrdiff_t step, const float* weights, int taps) {
  float sums[4] = {};
  int k = 0;
#if HWY_TARGET != HWY_SCALAR  // which has no vectors of four
  const hn::CappedTag<float, 4> d;
  const hn::Rebind<T, decltype(d)> d_pixel;
  const hn::Rebind<std::int32_t, decltype(d)> d_int;
  auto sum = hn::Zero(d);
  for (; k + 4 <= taps; k += 4, pixels += 4 * step) {
    // Together in one register, for single pixels could not be loaded as four until they are written.
    constexpr int kBits = 8 * sizeof(T);
    const std::uint64_t four = std::uint64_t{pixels[0]} | std::uint64_t{pixels[step]} << kBits |
                               std::uint64_t{pixels[2 * step]} << (2 * kBits) |
                               std::uint64_t{pixels[3 * step]} << (3 * kBits);
    T grey[4];
    std::memcpy(grey, &four, sizeof(grey));
    const auto value = hn::ConvertTo(d, hn::PromoteTo(d_int, hn::LoadU(d_pixel, step == 1 ? pixels : grey)));
    sum = hn::MulAdd(hn::LoadU(d, weights + k), value, sum);
  }
  hn::StoreU(sum, d, sums);
#endif
  for (; k < taps; ++k, pixels += step) sums[0] += weights[k] * static_cast<float>(*pixels);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

float row_sum8(const std::uint8_t* pixels, std::ptrdiff_t step, const float* weights, int taps) {
  // A step that the compiler knows needs no pixels one by one.
  return step == 1 ? row_sum(pixels, 1, weights, taps) : row_sum(pixels, step, weights, taps);
}
float row_sum16(const std::uint16_t* pixels, std::ptrdiff_t step, const float* weights, int taps) {
  return step == 1 ? row_sum(pixels, 1, weights, taps) : row_sum(pixels, step, weights, taps);
}

Derivatives window8(const std::uint8_t* top_left, std::ptrdiff_t stride, const float* wx, const float* wy,
                    int taps, int pitch) {
  return window(top_left, stride, wx, wy, taps, pitch);
}
Derivatives window16(const std::uint16_t* top_left, std::ptrdiff_t stride, const float* wx, const float* wy,
                     int taps, int pitch) {
  return window(top_left, stride, wx, wy, taps, pitch);
}

}  // namespace HWY_NAMESPACE
}  // namespace lightstripe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightstripe {

HWY_EXPORT(window8);
HWY_EXPORT(window16);
HWY_EXPORT(row_sum8);
HWY_EXPORT(row_sum16);

float weighted_sum(const std::uint8_t* pixels, std::ptrdiff_t step, const float* weights, int taps) {
  return HWY_DYNAMIC_DISPATCH(row_sum8)(pixels, step, weights, taps);
}

float weighted_sum(const std::uint16_t* pixels, std::ptrdiff_t step, const float* weights, int taps) {
  return HWY_DYNAMIC_DISPATCH(row_sum16)(pixels, step, weights, taps);
}

Derivatives window_derivatives(const std::uint8_t* top_left, std::ptrdiff_t stride, const float* weights_x,
                               const float* weights_y, int taps, int pitch) {
  return HWY_DYNAMIC_DISPATCH(window8)(top_left, stride, weights_x, weights_y, taps, pitch);
}

Derivatives window_derivatives(const std::uint16_t* top_left, std::ptrdiff_t stride, const float* weights_x,
                               const float* weights_y, int taps, int pitch) {
  return HWY_DYNAMIC_DISPATCH(window16)(top_left, stride, weights_x, weights_y, taps, pitch);
}

}  // namespace lightstripe
#endif  // HWY_ONCE
