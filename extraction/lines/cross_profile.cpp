// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/cross_profile.h"

#include <algorithm>
#include <type_traits>

namespace lightstripe {
namespace {

/// Sum of three pixels around `index`, moved inside the line, which has as many.
template <class T>
inline auto sum_of_three(const PixelLine<T>& line, int index) {
  const T* at = line.first + std::clamp(index, 1, line.count - 2) * line.step;
  return at[-line.step] + at[0] + at[line.step];
}

/// The lower mean of three pixels of those around two places: sums are compared, which are whole numbers.
template <class T>
inline double lower_mean(const PixelLine<T>& line, int a, int b) {
  if (line.count >= 3)
    return static_cast<double>(std::min(sum_of_three(line, a), sum_of_three(line, b))) * (1.0 / 3.0);
  return std::min(line[std::clamp(a, 0, line.count - 1)], line[std::clamp(b, 0, line.count - 1)]);
}

/// What a grey value has to reach to be above a level: whole grey values are compared as such, which is
/// faster.
template <class T>
auto comparable(double level) {
  if constexpr (std::is_integral_v<T>)
    return static_cast<int>(level) + 1;
  else
    return static_cast<T>(level);
}

/// Distances from the centre to where the grey value falls below two levels; -1 where it does not.
struct Flank {
  double half = -1, foot = -1;
};

/// One side of the profile, from the pixel `start` on, `step` elements from pixel to pixel, of which `count`
/// may be looked at. `ahead`: from the centre to the start pixel in that direction, px.
template <class T>
Flank measure_flank(const T* start, std::ptrdiff_t step, int count, double ahead, double half_level,
                    double foot_level) {
  const auto place = [&](int k, double level) {
    const double previous{static_cast<double>(start[(k - 1) * step])},
        grey{static_cast<double>(start[k * step])};
    return ahead + k - 1 + (previous > level ? (previous - level) / (previous - grey) : 0.0);
  };
  const auto half = comparable<T>(half_level), foot = comparable<T>(foot_level);
  Flank flank;
  int k = 1;
  while (k <= count && start[k * step] >= half) ++k;
  if (k > count) return flank;
  flank.half = place(k, half_level);
  while (k <= count && start[k * step] >= foot) ++k;
  if (k <= count) flank.foot = place(k, foot_level);
  return flank;
}

}  // namespace

template <class T>
CrossProfile measure_profile(PixelLine<T> line, double centre, int reach) {
  CrossProfile p;
  const int c = std::clamp(static_cast<int>(centre + 0.5), 0, line.count - 1);
  const double before = line[std::max(c - 1, 0)], at = line[c], after = line[std::min(c + 1, line.count - 1)];
  p.top = 0.25 * (before + 2 * at + after);
  p.brightest = std::max({before, at, after});
  const int near = std::max(2, reach * 2 / 3);
  p.background_left = lower_mean(line, c - reach, c - near);
  p.background_right = lower_mean(line, c + reach, c + near);
  const T* start = line.first + c * line.step;
  const auto flank = [&](int direction, int pixels, double background) {
    const double height = p.top - background;
    return measure_flank(start, direction * line.step, std::min(reach, pixels), (c - centre) * direction,
                         background + 0.5 * height, background + kWidthLevel * height);
  };
  const Flank left = flank(-1, c, p.background_left);
  const Flank right = flank(+1, line.count - 1 - c, p.background_right);
  p.bounded = left.foot >= 0 && right.foot >= 0;
  p.left = left.foot >= 0 ? left.foot : reach;
  p.right = right.foot >= 0 ? right.foot : reach;
  p.half_level_width = left.half >= 0 && right.half >= 0 ? left.half + right.half : 0.0;
  return p;
}

template CrossProfile measure_profile<std::uint8_t>(PixelLine<std::uint8_t>, double, int);
template CrossProfile measure_profile<std::uint16_t>(PixelLine<std::uint16_t>, double, int);
template CrossProfile measure_profile<float>(PixelLine<float>, double, int);

}  // namespace lightstripe
