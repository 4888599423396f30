// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Gaussian derivatives of the image at single sub-pixel places: what line following lives on.
// Steger 1998, section 2.3: kernels integrated over the pixel (differences of the Gaussian's integral).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"

namespace lightstripe {

/// The smoothed image and its partial derivatives at one place; grey levels per px^order.
struct Derivatives {
  float value = 0, dx = 0, dy = 0, dxx = 0, dxy = 0, dyy = 0;
};

/// One-dimensional kernels of order 0, 1, 2 for `kPhases` sub-pixel shifts. A kernel pair (x, y) gives the
/// derivatives at a place between the pixels, so that no phase bias remains (see refine_points()).
struct DerivativeKernels {
  static constexpr int kPhases = 32;

  double sigma = 0;            ///< px
  int radius = 0;              ///< px, 3.2 sigma
  int taps = 0;                ///< 2 * radius + 2: both ends of a shifted kernel
  int pitch = 0;               ///< taps rounded up to kLanes; the rest is zero
  std::vector<float> weights;  ///< [phase][order][pitch]
  double gradient_gain = 0;    ///< standard deviation of dx for pixel noise of 1 grey level
  double curvature_gain = 0;   ///< the same of dxx

  /// A window is read in whole vectors of this many pixels.
  static constexpr int kLanes = 16;
  const float* phase(int index) const {
    return weights.data() + static_cast<std::ptrdiff_t>(index) * 3 * pitch;
  }
  /// Strength (-second derivative across) of a Gaussian stripe of peak 1 whose standard deviation is sigma.
  double matched_strength() const { return 1.0 / (2.0 * 1.4142135623730951 * sigma * sigma); }
};

/// Kernels of scale `sigma` px, 0.4 <= sigma <= 40.
DerivativeKernels make_derivative_kernels(double sigma);

/// A place rounded to the phases of the kernels.
struct PhasedPosition {
  int pixel = 0;  ///< floor
  int phase = 0;  ///< [0, kPhases)
  double value() const { return pixel + phase * (1.0 / DerivativeKernels::kPhases); }
};
inline PhasedPosition to_phase(double coordinate) {
  // floor() without its call, which plain x86-64 has no instruction for.
  const double scaled = coordinate * DerivativeKernels::kPhases + 0.5;
  int steps = static_cast<int>(scaled);
  if (steps > scaled) --steps;
  constexpr int kMask = DerivativeKernels::kPhases - 1;
  return {(steps - (steps & kMask)) / DerivativeKernels::kPhases, steps & kMask};
}

/// `top_left`: the window's first pixel; taps rows, of each `pitch` pixels may be read (those from `taps` on
/// have weight 0). `weights_x`, `weights_y`: three kernels of `pitch` weights. Vectors of the best
/// instruction set at hand.
Derivatives window_derivatives(const std::uint8_t* top_left, std::ptrdiff_t stride, const float* weights_x,
                               const float* weights_y, int taps, int pitch);
Derivatives window_derivatives(const std::uint16_t* top_left, std::ptrdiff_t stride, const float* weights_x,
                               const float* weights_y, int taps, int pitch);

/// The same where the window reaches over the border, or whole vectors of it would.
template <class T>
Derivatives evaluate_at_border(const ImageView<T>& image, PhasedPosition x, PhasedPosition y,
                               const DerivativeKernels& kernels, double tangent_x, double tangent_y,
                               std::vector<T>& border_window);

/// Derivatives at (x, y), both rounded to 1/32 px. Beyond the border the image is continued along the
/// direction (tangent_x, tangent_y), so that a slanted line runs out of the picture straight;
/// with (0, 0) the border pixels are repeated. `border_window` is scratch memory.
template <class T>
inline Derivatives evaluate_derivatives(const ImageView<T>& image, PhasedPosition x, PhasedPosition y,
                                        const DerivativeKernels& kernels, double tangent_x, double tangent_y,
                                        std::vector<T>& border_window) {
  const int left = x.pixel - kernels.radius, top = y.pixel - kernels.radius, last_row = top + kernels.taps;
  // Whole vectors are read: in the image's last rows they must not run over its end, elsewhere the next row
  // follows.
  const int readable = last_row < image.height ? kernels.taps : kernels.pitch;
  if (left >= 0 && top >= 0 && left + readable <= image.width && last_row <= image.height &&
      kernels.pitch <= image.width)
    return window_derivatives(image.row(top) + left, image.stride, kernels.phase(x.phase),
                              kernels.phase(y.phase), kernels.taps, kernels.pitch);
  return evaluate_at_border(image, x, y, kernels, tangent_x, tangent_y, border_window);
}

}  // namespace lightstripe
