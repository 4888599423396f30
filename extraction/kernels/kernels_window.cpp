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

/// The six sums, lane by lane.
template <class D>
struct LaneSums {
  hn::Vec<D> value, dx, dy, dxx, dxy, dyy;
};
template <class D>
HWY_INLINE LaneSums<D> no_sums(D d) {
  const auto zero = hn::Zero(d);
  return {zero, zero, zero, zero, zero, zero};
}

/// Columns filtered along their length by the three kernels.
template <class D>
struct Columns {
  hn::Vec<D> smooth, slope, curvature;
};
template <class D>
HWY_INLINE Columns<D> no_columns(D d) {
  const auto zero = hn::Zero(d);
  return {zero, zero, zero};
}

/// One pixel of each column more. `wy`: the weight of its row in the first kernel.
template <class D>
HWY_INLINE void add_row(D d, hn::Vec<D> grey, const float* wy, int pitch, Columns<D>& c) {
  c.smooth = hn::MulAdd(grey, hn::Set(d, wy[0]), c.smooth);
  c.slope = hn::MulAdd(grey, hn::Set(d, wy[pitch]), c.slope);
  c.curvature = hn::MulAdd(grey, hn::Set(d, wy[2 * pitch]), c.curvature);
}

/// `wx`: the columns' weights.
template <class D>
HWY_INLINE void add_columns(D d, const Columns<D>& c, const float* wx, int pitch, LaneSums<D>& sums) {
  const auto x0 = hn::LoadU(d, wx), x1 = hn::LoadU(d, wx + pitch), x2 = hn::LoadU(d, wx + 2 * pitch);
  sums.value = hn::MulAdd(c.smooth, x0, sums.value);
  sums.dx = hn::MulAdd(c.smooth, x1, sums.dx);
  sums.dxx = hn::MulAdd(c.smooth, x2, sums.dxx);
  sums.dy = hn::MulAdd(c.slope, x0, sums.dy);
  sums.dxy = hn::MulAdd(c.slope, x1, sums.dxy);
  sums.dyy = hn::MulAdd(c.curvature, x0, sums.dyy);
}

template <class D, class T>
HWY_INLINE hn::Vec<D> grey_of(D d, const T* pixels) {
  const hn::Rebind<T, D> d_pixel;
  const hn::Rebind<std::int32_t, D> d_int;
  return hn::ConvertTo(d, hn::PromoteTo(d_int, hn::LoadU(d_pixel, pixels)));
}

/// One vector of columns, two rows at once (their number is even): the sums of one would wait for each other.
template <class D, class T>
HWY_INLINE void add_one_vector(D d, const T* pixel, std::ptrdiff_t stride, const float* wx, const float* wy,
                               int taps, int pitch, LaneSums<D>& sums) {
  auto even = no_columns(d), odd = no_columns(d);
  for (int j = 0; j < taps; j += 2, pixel += 2 * stride) {
    add_row(d, grey_of(d, pixel), wy + j, pitch, even);
    add_row(d, grey_of(d, pixel + stride), wy + j + 1, pitch, odd);
  }
  add_columns(d,
              Columns<D>{hn::Add(even.smooth, odd.smooth), hn::Add(even.slope, odd.slope),
                         hn::Add(even.curvature, odd.curvature)},
              wx, pitch, sums);
}

/// Two vectors of columns side by side; the second one may be shorter.
template <class D, class E, class T>
HWY_INLINE void add_two_vectors(D d, E e, const T* pixel, std::ptrdiff_t stride, const float* wx,
                                const float* wy, int taps, int pitch, LaneSums<D>& sums_d,
                                LaneSums<E>& sums_e) {
  const auto lanes = static_cast<int>(hn::Lanes(d));
  auto left = no_columns(d);
  auto right = no_columns(e);
  for (int j = 0; j < taps; ++j, pixel += stride) {
    add_row(d, grey_of(d, pixel), wy + j, pitch, left);
    add_row(e, grey_of(e, pixel + lanes), wy + j, pitch, right);
  }
  add_columns(d, left, wx, pitch, sums_d);
  add_columns(e, right, wx + lanes, pitch, sums_e);
}

#if HWY_TARGET != HWY_SCALAR && !HWY_HAVE_SCALABLE
/// Sums of lanes that lie four apart.
template <class D>
HWY_INLINE auto to_four(D d, hn::Vec<D> v) {
  if constexpr (hn::MaxLanes(d) > 4) {
    const hn::Half<D> half;
    return to_four(half, hn::Add(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  } else {
    return v;
  }
}
using Four = hn::FixedTag<float, 4>;

template <class D>
HWY_INLINE LaneSums<Four> four_of(D d, const LaneSums<D>& s) {
  return {to_four(d, s.value), to_four(d, s.dx),  to_four(d, s.dy),
          to_four(d, s.dxx),   to_four(d, s.dxy), to_four(d, s.dyy)};
}

/// All six at once: one by one each would wait for its own chain of shuffles.
HWY_INLINE Derivatives sums_of_four(const LaneSums<Four>& s) {
  const Four d;
  const auto pair = [d](auto a, auto b) {  // a0 + a2, b0 + b2, a1 + a3, b1 + b3
    return hn::Add(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b));
  };
  const auto ab = pair(s.value, s.dx), cd = pair(s.dy, s.dxx), ef = pair(s.dxy, s.dyy);
  HWY_ALIGN float sums[8];
  hn::Store(hn::Add(hn::ConcatLowerLower(d, cd, ab), hn::ConcatUpperUpper(d, cd, ab)), d, sums);
  hn::Store(hn::Add(ef, hn::ConcatUpperUpper(d, ef, ef)), d, sums + 4);
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5]};
}

template <class D>
HWY_INLINE Derivatives sums_of_lanes(D d, const LaneSums<D>& s) {
  return sums_of_four(four_of(d, s));
}
#else
template <class D>
HWY_INLINE Derivatives sums_of_lanes(D d, const LaneSums<D>& s) {
  const auto sum = [d](hn::Vec<D> v) { return hn::GetLane(hn::SumOfLanes(d, v)); };
  return {sum(s.value), sum(s.dx), sum(s.dy), sum(s.dxx), sum(s.dxy), sum(s.dyy)};
}
#endif

template <class D, class T>
HWY_INLINE Derivatives window_of(D d, const T* top_left, std::ptrdiff_t stride, const float* wx,
                                 const float* wy, int taps, int pitch) {
  const auto lanes = static_cast<int>(hn::Lanes(d));
  LaneSums<D> sums = no_sums(d);
#if HWY_TARGET != HWY_SCALAR && !HWY_HAVE_SCALABLE
  if constexpr (hn::MaxLanes(d) == 16) {
    // So wide are the kernels of most stripes: of two whole vectors a quarter would be in vain.
    if (taps > 16 && taps <= 24) {
      const hn::Half<D> half;
      LaneSums<hn::Half<D>> right = no_sums(half);
      add_two_vectors(d, half, top_left, stride, wx, wy, taps, pitch, sums, right);
      const LaneSums<Four> a = four_of(d, sums), b = four_of(half, right);
      return sums_of_four({hn::Add(a.value, b.value), hn::Add(a.dx, b.dx), hn::Add(a.dy, b.dy),
                           hn::Add(a.dxx, b.dxx), hn::Add(a.dxy, b.dxy), hn::Add(a.dyy, b.dyy)});
    }
  }
#endif
  int i = 0;
  for (; i + lanes < taps; i += 2 * lanes)
    add_two_vectors(d, d, top_left + i, stride, wx + i, wy, taps, pitch, sums, sums);
  if (i < taps) add_one_vector(d, top_left + i, stride, wx + i, wy, taps, pitch, sums);
  return sums_of_lanes(d, sums);
}

template <class T>
Derivatives window(const T* top_left, std::ptrdiff_t stride, const float* wx, const float* wy, int taps,
                   int pitch) {
  return window_of(hn::CappedTag<float, DerivativeKernels::kLanes>(), top_left, stride, wx, wy, taps, pitch);
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
