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

/// Distance from `centre` to where the grey value falls below `level`, going by `direction`; -1 where it does
/// not.
template <class T>
double flank_distance(const PixelLine<T>& line, double centre, int start, int direction, int reach,
                      double level) {
  double previous = line[start];
  for (int k = 1; k <= reach; ++k) {
    const int index = start + direction * k;
    if (index < 0 || index >= line.count) return -1;
    const double grey = line[index];
    if (grey < level) {
      const double part = previous > level ? (previous - level) / (previous - grey) : 0.0;
      return (start - centre) * direction + k - 1 + part;
    }
    previous = grey;
  }
  return -1;
}

}  // namespace

template <class T>
CrossProfile measure_profile(PixelLine<T> line, double centre, int reach) {
  CrossProfile p;
  const int c = std::clamp(static_cast<int>(std::lround(centre)), 0, line.count - 1);
  const double before = line[std::max(c - 1, 0)], at = line[c], after = line[std::min(c + 1, line.count - 1)];
  p.top = 0.25 * (before + 2 * at + after);
  p.brightest = std::max({before, at, after});
  const int near = std::max(2, reach * 2 / 3);
  p.background_left = std::min(mean_of_three(line, c - reach), mean_of_three(line, c - near));
  p.background_right = std::min(mean_of_three(line, c + reach), mean_of_three(line, c + near));
  const double level_left = p.background_left + kWidthLevel * (p.top - p.background_left);
  const double level_right = p.background_right + kWidthLevel * (p.top - p.background_right);
  p.left = flank_distance(line, centre, c, -1, reach, level_left);
  p.right = flank_distance(line, centre, c, +1, reach, level_right);
  p.bounded = p.left >= 0 && p.right >= 0;
  if (p.left < 0) p.left = reach;
  if (p.right < 0) p.right = reach;
  return p;
}

template CrossProfile measure_profile<std::uint8_t>(PixelLine<std::uint8_t>, double, int);
template CrossProfile measure_profile<std::uint16_t>(PixelLine<std::uint16_t>, double, int);

}  // namespace lightstripe
