// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Stripes as lasers on real surfaces draw them, with known centres: speckle, clipping, glow, brightness
// steps, mirror images; and how well extracted lines follow them.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/image.h"
#include "core/stripe.h"
#include "simulate/speckle.h"

namespace lightstripe {

/// A stripe that runs down a picture: its centre in each row, its profile, what lies behind it.
struct RealStripe {
  int width = 160, height = 480;  ///< px
  std::function<double(double)> centre = [](double y) { return 80 + 18 * std::sin(y / 80); };
  double peak = 150, sigma = 2;                               ///< grey levels, px across the line
  double background = 8, read_noise = 1.5, shot_gain = 0.05;  ///< grey levels
  Speckle speckle = {0, 1.2};
  double exposure = 1;              ///< times `peak`
  double glow = 0, glow_reach = 6;  ///< share of the peak; px, to the right
  double step = 0, step_at = 0;  ///< share of the peak that the right side is brighter by, from there on, px
  double mirror = 0, mirror_at = 10;  ///< share of the peak; px beside

  /// cosine of the angle between a row and the line's normal.
  double cosine(double y) const {
    const double slope = 0.5 * (centre(y + 1) - centre(y - 1));
    return 1 / std::sqrt(1 + slope * slope);
  }
};

/// The same seed gives the same bits.
Image8 picture_of(const RealStripe& stripe, std::uint64_t seed);

/// What became of such stripes, over several pictures.
struct RealScore {
  double rows = 0, found = 0;           ///< rows of the pictures, and with a point on the line
  double points = 0, false_points = 0;  ///< more than 4 px and 1.5 widths off
  double lines = 0;
  double squares = 0, predicted = 0;  ///< px^2, sums over the points on the line
  double surprise = 0;                ///< sum of (error / sigma_px)^2

  double completeness() const { return found / rows; }
  double rms() const { return std::sqrt(squares / std::max(1.0, points - false_points)); }
  double sigma() const { return std::sqrt(predicted / std::max(1.0, points - false_points)); }
  double variance_ratio() const { return squares / predicted; }
  double rms_surprise() const { return std::sqrt(surprise / std::max(1.0, points - false_points)); }
};

void add_to(RealScore& score, const RealStripe& truth, const std::vector<Stripe>& stripes);

}  // namespace lightstripe
