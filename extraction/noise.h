// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How noisy an image is, measured in the image itself.
#pragma once

#include "core/image.h"

namespace lightstripe {

/// Standard deviation of the pixel noise where most of the image lies, grey levels: the median of the second
/// differences along every `row_step`-th row, which stripes and edges hardly move. Where the background is
/// clipped at 0 only the unclipped half of the noise is seen, and made up for. At least the quantisation
/// noise, 1 / sqrt(12).
template <class T>
double estimate_noise(ImageView<T> image, int row_step = 1);

}  // namespace lightstripe
