// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/kernels/kernels_scan.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "extraction/kernels/kernels_scan.cpp"
// Highway compiles this file once for each instruction set.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightstripe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class T>
T largest(const T* pixels, std::size_t count) {
  const hn::ScalableTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  auto best = hn::Zero(d);
  std::size_t i = 0;
  // Four at a time: the loop's own work would cost as much as the comparing.
  for (auto a = best, b = best, c = best; i + 4 * lanes <= count; i += 4 * lanes) {
    best = hn::Max(best, hn::LoadU(d, pixels + i));
    a = hn::Max(a, hn::LoadU(d, pixels + i + lanes));
    b = hn::Max(b, hn::LoadU(d, pixels + i + 2 * lanes));
    c = hn::Max(c, hn::LoadU(d, pixels + i + 3 * lanes));
    if (i + 8 * lanes > count) best = hn::Max(hn::Max(best, a), hn::Max(b, c));
  }
  for (; i + lanes <= count; i += lanes) best = hn::Max(best, hn::LoadU(d, pixels + i));
  HWY_ALIGN T lane_values[HWY_MAX_BYTES / sizeof(T)];
  hn::Store(best, d, lane_values);
  T result = 0;
  for (std::size_t k = 0; k < lanes; ++k) result = lane_values[k] > result ? lane_values[k] : result;
  for (; i < count; ++i) result = pixels[i] > result ? pixels[i] : result;
  return result;
}

template <class T>
bool candidates(const ScanRow<T>& row, int width, const ScanRule<T>& rule, std::uint64_t* masks,
                T* contrasts) {
  const hn::CappedTag<T, 64> d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  for (int word = 0; word < (width + 63) / 64; ++word) masks[word] = 0;
  // x >= least is the same as (x saturating-minus (least - 1)) != 0, and that is one instruction.
  const auto below_level = hn::Set(d, static_cast<T>(rule.level > 0 ? rule.level - 1 : 0));
  const auto below_contrast = hn::Set(d, static_cast<T>(rule.contrast - 1));
  // What is darker than the contrast cannot be brighter by it than anything: in a dark picture one look at
  // the row itself is enough for nearly all of it.
  const auto too_dark = hn::Max(below_level, below_contrast);
  const auto zero = hn::Zero(d);
  bool any = false;
  const int last = width - rule.reach;
  int x = rule.reach;
  // The last vector of a row overlaps the one before: rows seldom end where a vector does.
  for (; x < last && rule.reach + lanes <= last; x += lanes) {
    x = x + lanes <= last ? x : last - lanes;
    const auto grey = hn::LoadU(d, row.centre + x);
    if (hn::AllTrue(d, hn::Eq(hn::SaturatedSub(grey, too_dark), zero))) continue;
    const auto across_row = hn::Min(hn::SaturatedSub(grey, hn::LoadU(d, row.centre + x - rule.reach)),
                                    hn::SaturatedSub(grey, hn::LoadU(d, row.centre + x + rule.reach)));
    const auto across_column = hn::Min(hn::SaturatedSub(grey, hn::LoadU(d, row.above + x)),
                                       hn::SaturatedSub(grey, hn::LoadU(d, row.below + x)));
    const auto contrast = hn::Max(across_row, across_column);
    const auto excess = hn::Min(hn::SaturatedSub(contrast, below_contrast),
                                rule.level > 0 ? hn::SaturatedSub(grey, below_level) : hn::Set(d, T{1}));
    const auto mask = hn::Ne(excess, zero);
    if (hn::AllFalse(d, mask)) continue;
    any = true;
    if (contrasts != nullptr) hn::StoreU(contrast, d, contrasts + x);
    std::uint8_t bytes[16] = {};
    hn::StoreMaskBits(d, mask, bytes);
    std::uint64_t bits = 0;
    for (int k = 0; k < (lanes + 7) / 8; ++k) bits |= static_cast<std::uint64_t>(bytes[k]) << (8 * k);
    masks[x / 64] |= bits << (x % 64);
    if (x % 64 != 0 && x % 64 + lanes > 64) masks[x / 64 + 1] |= bits >> (64 - x % 64);
  }
  for (; x < last; ++x) {
    const T contrast = candidate_contrast(row, x, width, rule.reach);
    if (row.centre[x] < rule.level || contrast < rule.contrast) continue;
    masks[x / 64] |= std::uint64_t{1} << (x % 64);
    if (contrasts != nullptr) contrasts[x] = contrast;
    any = true;
  }
  return any;
}

template <class T>
void halve_scalar(const T* a, const T* b, std::size_t begin, std::size_t end, T* out) {
  for (std::size_t x = begin; x < end; ++x)
    out[x] = static_cast<T>((std::uint32_t{a[2 * x]} + a[2 * x + 1] + b[2 * x] + b[2 * x + 1] + 2) / 4);
}

void halve8(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* out) {
  std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR  // which has no vectors of two halves
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Repartition<std::uint8_t, decltype(d)> d_pixel;
  const hn::Rebind<std::uint8_t, decltype(d)> d_half;
  const std::size_t lanes = hn::Lanes(d);
  const auto low = hn::Set(d, std::uint16_t{255}), two = hn::Set(d, std::uint16_t{2});
  for (; x + lanes <= count; x += lanes) {
    const auto p = hn::BitCast(d, hn::LoadU(d_pixel, a + 2 * x)),
               q = hn::BitCast(d, hn::LoadU(d_pixel, b + 2 * x));
    const auto upper = hn::Add(hn::And(p, low), hn::ShiftRight<8>(p)),
               lower = hn::Add(hn::And(q, low), hn::ShiftRight<8>(q));
    const auto mean = hn::ShiftRight<2>(hn::Add(hn::Add(upper, lower), two));
    hn::StoreU(hn::DemoteTo(d_half, hn::BitCast(hn::RebindToSigned<decltype(d)>(), mean)), d_half, out + x);
  }
#endif
  halve_scalar(a, b, x, count, out);
}
void halve16(const std::uint16_t* a, const std::uint16_t* b, std::size_t count, std::uint16_t* out) {
  halve_scalar(a, b, 0, count, out);
}

std::uint8_t largest8(const std::uint8_t* pixels, std::size_t count) { return largest(pixels, count); }
std::uint16_t largest16(const std::uint16_t* pixels, std::size_t count) { return largest(pixels, count); }
bool candidates8(const ScanRow<std::uint8_t>& row, int width, const ScanRule<std::uint8_t>& rule,
                 std::uint64_t* masks, std::uint8_t* contrasts) {
  return candidates(row, width, rule, masks, contrasts);
}
bool candidates16(const ScanRow<std::uint16_t>& row, int width, const ScanRule<std::uint16_t>& rule,
                  std::uint64_t* masks, std::uint16_t* contrasts) {
  return candidates(row, width, rule, masks, contrasts);
}

}  // namespace HWY_NAMESPACE
}  // namespace lightstripe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightstripe {

HWY_EXPORT(largest8);
HWY_EXPORT(largest16);
HWY_EXPORT(halve8);
HWY_EXPORT(halve16);
HWY_EXPORT(candidates8);
HWY_EXPORT(candidates16);

std::uint8_t largest_pixel(const std::uint8_t* pixels, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(largest8)(pixels, count);
}
std::uint16_t largest_pixel(const std::uint16_t* pixels, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(largest16)(pixels, count);
}
void halve_rows(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(halve8)(a, b, count, out);
}
void halve_rows(const std::uint16_t* a, const std::uint16_t* b, std::size_t count, std::uint16_t* out) {
  HWY_DYNAMIC_DISPATCH(halve16)(a, b, count, out);
}
bool mark_candidates(const ScanRow<std::uint8_t>& row, int width, const ScanRule<std::uint8_t>& rule,
                     std::uint64_t* masks, std::uint8_t* contrasts) {
  return HWY_DYNAMIC_DISPATCH(candidates8)(row, width, rule, masks, contrasts);
}
bool mark_candidates(const ScanRow<std::uint16_t>& row, int width, const ScanRule<std::uint16_t>& rule,
                     std::uint64_t* masks, std::uint16_t* contrasts) {
  return HWY_DYNAMIC_DISPATCH(candidates16)(row, width, rule, masks, contrasts);
}

}  // namespace lightstripe
#endif  // HWY_ONCE
