// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How far a line's centre may be off because its two sides are not alike: glow below the surface, a step in
// the brightness behind it, a mirror image beside it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Scratch memory.
struct AsymmetryWorkspace {
  std::vector<std::uint32_t> sums;  ///< grey values across a stretch of the line
  std::vector<float> profile;       ///< the same, all in one direction
  std::vector<double> asides;       ///< px, of each stretch
  std::vector<double> scatter;
};

/// Adds to sigma_px what the flanks tell, and flags the points where that is the larger part. A symmetric
/// stripe has one centre for kernels of any scale; the centres by a narrower and by a broader kernel, on
/// profiles averaged along the line, tell how far it may be off. A bias cannot be taken back: where the light
/// came from is not known. sigma_px must be set.
template <class T>
void add_asymmetry(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines,
                   AsymmetryWorkspace& workspace);

}  // namespace lightstripe
