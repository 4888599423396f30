// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The stripe's own grey values, unsmoothed, along the row or column that crosses it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/image.h"

namespace lightstripe {

/// The full width 2w of a stripe is taken where the grey value has fallen to exp(-3/2) of the peak: that is
/// 2w for a flat bar and 2 sqrt(3) s for a Gaussian, the bar of the same standard deviation (w = sqrt(3) s,
/// Steger's rule).
inline constexpr double kWidthLevel = 0.22313016014842982;

/// The same full width where the flanks are steep: pixels blur the foot of a sharp bar, but not its width at
/// half the peak. `foot` at kWidthLevel, `half` at half the peak; their ratio tells the bar (1) from the
/// Gaussian (1.471).
inline double bar_width(double foot, double half) {
  constexpr double kGaussian = 0.4710;  // sqrt(3) / sqrt(2 ln 2) - 1
  if (!(half > 0)) return foot;
  if (foot > (1 + kGaussian) * half) return foot;
  const double excess = foot > half ? foot / half - 1 : 0.0;
  return half * (1 + excess * excess * (1 / kGaussian));
}

/// Lengths in px along the row or column.
struct CrossProfile {
  double left = 0, right = 0;                        ///< from the centre to the width level, at most `reach`
  double half_level_width = 0;                       ///< full width at half the peak
  double background_left = 0, background_right = 0;  ///< grey levels
  double top = 0;        ///< grey level at the centre, of three pixels weighted 1:2:1
  double brightest = 0;  ///< grey level, largest of the three
  bool bounded = false;  ///< both flanks were found within `reach`

  double contrast() const {
    return top - (background_left > background_right ? background_left : background_right);
  }
  double intensity() const { return top - 0.5 * (background_left + background_right); }
  double width() const { return left + right; }
};

/// One row or column of an image.
template <class T>
struct PixelLine {
  const T* first = nullptr;
  std::ptrdiff_t step = 1;  ///< elements from pixel to pixel
  int count = 0;
  double operator[](int index) const { return first[index * step]; }
};

template <class T>
PixelLine<T> row_line(ImageView<T> image, int y) {
  return {image.row(y), 1, image.width};
}
template <class T>
PixelLine<T> column_line(ImageView<T> image, int x) {
  return {image.data + x, image.stride, image.height};
}

/// Profile around `centre` (inside the line). The background of each side is the lower of two means of three
/// pixels, at distance `reach` and at two thirds of it, so that a neighbouring stripe is not taken for
/// background.
template <class T>
CrossProfile measure_profile(PixelLine<T> line, double centre, int reach);

}  // namespace lightstripe
