// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Tests single places of an image for the ridge of a line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"
#include "core/stripe.h"
#include "extraction/follow/line_point.h"
#include "extraction/follow/ridge_limits.h"
#include "extraction/kernels/kernels.h"

namespace lightstripe {

/// Nearest whole number (a pixel's column or row) of a coordinate of at least -1e6; faster than lround.
inline int nearest_pixel(double coordinate) { return static_cast<int>(coordinate + 1000000.5) - 1000000; }

struct NearestPixel {
  int x, y;
};

/// The image's pixel nearest to a place, which may lie beside the image.
template <class T>
NearestPixel nearest_inside(ImageView<T> image, double x, double y) {
  return {std::clamp(nearest_pixel(x), 0, image.width - 1),
          std::clamp(nearest_pixel(y), 0, image.height - 1)};
}

/// Unit vector along the line in the sense of following.
struct Direction {
  double x = 1, y = 0;
  /// Steps go from column to column (else from row to row).
  bool column_wise() const { return x * x >= y * y; }
  Direction rotated(double cosine, double sine) const {
    return {x * cosine - y * sine, x * sine + y * cosine};
  }
  double dot(const Direction& o) const { return x * o.x + y * o.y; }
};
/// What makes (1 - u) a + u b a unit vector, for unit vectors whose difference has this squared length.
inline double length_correction(double squared_difference, double u) {
  constexpr double kSmall = 0.003;                    // up to here the series' next term is below 1e-10
  const double e = u * (1 - u) * squared_difference;  // the sum's squared length is 1 - e
  return e < kSmall ? 1 + e * (0.5 + e * (0.375 + e * 0.3125)) : 1 / std::sqrt(1 - e);
}
/// Unit vector between a and b, nearer to b with growing weight.
Direction blended(const Direction& a, const Direction& b, double weight_b);

/// How sure the direction at a ridge is.
enum class RidgeClarity : std::uint8_t {
  kClear,  ///< one line only: the surface's own direction
  kKept,   ///< the predicted direction, which the surface does not contradict (the line's brightness jumps
           ///< here)
  kDisturbed,  ///< the predicted direction against the surface: another line or a spot is near
};

/// A point found on the ridge of a line.
struct RidgePlace {
  double x = 0, y = 0;  ///< px; one of them is a whole number
  Direction direction;
  double strength = 0;  ///< grey levels / px^2
  RidgeClarity clarity = RidgeClarity::kClear;
};

StripePoint to_stripe_point(const RidgePlace& place);

/// Where a ridge is expected.
struct RidgeSearch {
  double x = 0, y = 0;  ///< px; whole-numbered in the direction of the step
  Direction direction;
  double reach = 0.75;  ///< px, largest distance of the ridge from the prediction along the row or column
  double least_cosine = 0.7;  ///< of the turn
  double least_strength = 0;
  bool clear_only = false;
  bool grain_counts = true;  ///< a grained line may look less like a line
};

template <class T>
struct RidgeFinder {
  ImageView<T> image;
  const DerivativeKernels& kernels;
  const RidgeLimits& limits;
  std::vector<T>& border_window;
  int bin_shift = 0;  ///< the image's pixels are 2^bin_shift pixels of the one that the mask is for

  /// A pixel of this image in the mask's.
  int in_mask(int pixel) const { return (pixel << bin_shift) + ((1 << bin_shift) >> 1); }

  /// The first point of a line near pixel (x, y): Newton steps across the strongest curvature.
  std::optional<RidgePlace> first_point(int x, int y) const;

  /// The ridge near a predicted place, Newton steps repeated until the last is shorter than 0.1 px,
  /// so that no phase bias remains. Nothing where there is none.
  std::optional<RidgePlace> find(const RidgeSearch& search) const;
};

}  // namespace lightstripe
