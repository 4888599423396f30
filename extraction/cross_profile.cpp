// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/cross_profile.h"

#include <algorithm>

namespace lightstripe {
namespace {

/// Mean of three pixels around `index`, moved inside the line.
template <class T>
double mean_of_three(const PixelLine<T>& line, int index) {
  if (line.count < 3) return line[std::clamp(index, 0, line.count - 1)];
  const int i = std::clamp(index, 1, line.count - 2);
  return (line[i - 1] + line[i] + line[i + 1]) * (1.0 / 3.0);
}

/// Distances from the centre to where the grey value falls below two levels; -1 where it does not.
struct Flank {
  double half = -1, foot = -1;
};

template <class T>
Flank measure_flank(const PixelLine<T>& line, double centre, int start, int direction, int reach,
                    double half_level, double foot_level) {
  Flank flank;
  double previous = line[start];
  const auto place = [&](int k, double grey, double level) {
    const double part = previous > level ? (previous - level) / (previous - grey) : 0.0;
    return (start - centre) * direction + k - 1 + part;
  };
  for (int k = 1; k <= reach; ++k) {
    const int index = start + direction * k;
    if (index < 0 || index >= line.count) return flank;
    const double grey = line[index];
    if (flank.half < 0 && grey < half_level) flank.half = place(k, grey, half_level);
    if (grey < foot_level) {
      flank.foot = place(k, grey, foot_level);
      return flank;
    }
    previous = grey;
  }
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
  p.background_left = std::min(mean_of_three(line, c - reach), mean_of_three(line, c - near));
  p.background_right = std::min(mean_of_three(line, c + reach), mean_of_three(line, c + near));
  const auto flank = [&](int direction, double background) {
    const double height = p.top - background;
    return measure_flank(line, centre, c, direction, reach, background + 0.5 * height,
                         background + kWidthLevel * height);
  };
  const Flank left = flank(-1, p.background_left), right = flank(+1, p.background_right);
  p.bounded = left.foot >= 0 && right.foot >= 0;
  p.left = left.foot >= 0 ? left.foot : reach;
  p.right = right.foot >= 0 ? right.foot : reach;
  p.half_level_width = left.half >= 0 && right.half >= 0 ? left.half + right.half : 0.0;
  return p;
}

template CrossProfile measure_profile<std::uint8_t>(PixelLine<std::uint8_t>, double, int);
template CrossProfile measure_profile<std::uint16_t>(PixelLine<std::uint16_t>, double, int);

}  // namespace lightstripe
