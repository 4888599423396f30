// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A picture of one curved line under speckle, with its known centre: what the error model is tried on.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "simulate/speckle.h"

namespace lightstripe {

/// A line that runs down a picture of 160 x 480 px, on a faint background with camera noise.
struct SpeckledStripe {
  Speckle speckle;
  double sigma_px = 2;  ///< standard deviation across
  double peak = 150;    ///< grey levels

  static constexpr int kWidth = 160, kHeight = 480;
  /// The line's x in a row, and the cosine between the row and the line's normal.
  static double centre(double y);
  static double cosine(double y);
};

/// The same seed gives the same bits.
Image8 render(const SpeckledStripe& stripe, std::uint64_t seed);

}  // namespace lightstripe
