// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Line points of whole pixels -> lines: Steger 1998, section 2.4, with hysteresis.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Steger's answer for the pixels of an image; strength 0 where there is no line point.
struct LinePointMap {
  int width = 0, height = 0;
  std::vector<float> strength;  ///< grey levels / px^2
  std::vector<float> offset_x, offset_y, normal_x, normal_y;

  void reset(int w, int h);
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// Enters a pixel's derivatives if they pass the line test: ridge inside the pixel, at least
  /// `least_strength`.
  void test_pixel(int x, int y, const Derivatives& d, double least_strength);
};

/// Lines start at the strongest free points of at least `start_strength`, and go on to the neighbour in the
/// line's direction with the smallest distance + angle difference.
void link_points(const LinePointMap& map, double start_strength, LineSet& lines);

/// A second Newton step: each point is moved to the ridge of derivatives taken at its sub-pixel place.
template <class T>
void refine_points(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines);

}  // namespace lightstripe
