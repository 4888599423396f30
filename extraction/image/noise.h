// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How noisy an image is, measured in the image itself.
#pragma once

#include "core/image.h"

namespace lightstripe {

/// Pixel noise, standard deviations in grey levels; at least the quantisation noise, 1 / sqrt(12).
struct NoiseEstimate {
  double seen = 0;  ///< as it is in the image where most of it lies
  double full = 0;  ///< as it would be without clipping at 0, which halves the noise of a dark background
};

/// From the median of the second differences along the rows, which stripes and edges hardly move, over about
/// one pixel in `thinning`, spread evenly.
template <class T>
NoiseEstimate estimate_noise(ImageView<T> image, int thinning = 1);

}  // namespace lightstripe
