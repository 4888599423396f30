// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The inner loops of point evaluation. window_derivatives() itself stands in kernels.h: one pass over a
// window, three vertical filters and six dot products.
#pragma once

#include <cstddef>
#include <cstdint>

#include "extraction/kernels/kernels.h"

namespace lightstripe {

/// Sum of `taps` pixels, `step` elements from one to the next, times their weights.
float weighted_sum(const std::uint8_t* pixels, std::ptrdiff_t step, const float* weights, int taps);
float weighted_sum(const std::uint16_t* pixels, std::ptrdiff_t step, const float* weights, int taps);

/// The same written plainly: the reference of the tests.
template <class T>
float weighted_sum_scalar(const T* pixels, std::ptrdiff_t step, const float* weights, int taps) {
  double sum = 0;
  for (int k = 0; k < taps; ++k, pixels += step) sum += double{weights[k]} * static_cast<double>(*pixels);
  return static_cast<float>(sum);
}

/// window_derivatives written plainly: the reference of the tests.
template <class T>
Derivatives window_derivatives_scalar(const T* top_left, std::ptrdiff_t stride, const float* weights_x,
                                      const float* weights_y, int taps, int pitch) {
  const float *x0 = weights_x, *x1 = weights_x + pitch, *x2 = weights_x + 2 * pitch;
  const float *y0 = weights_y, *y1 = weights_y + pitch, *y2 = weights_y + 2 * pitch;
  double value = 0, dx = 0, dy = 0, dxx = 0, dxy = 0, dyy = 0;
  for (int i = 0; i < taps; ++i) {
    double smooth = 0, slope = 0, curvature = 0;
    for (int j = 0; j < taps; ++j) {
      const double grey = top_left[j * stride + i];
      smooth += grey * y0[j];
      slope += grey * y1[j];
      curvature += grey * y2[j];
    }
    value += smooth * x0[i];
    dx += smooth * x1[i];
    dxx += smooth * x2[i];
    dy += slope * x0[i];
    dxy += slope * x1[i];
    dyy += curvature * x0[i];
  }
  return {static_cast<float>(value), static_cast<float>(dx),  static_cast<float>(dy),
          static_cast<float>(dxx),   static_cast<float>(dxy), static_cast<float>(dyy)};
}

}  // namespace lightstripe
