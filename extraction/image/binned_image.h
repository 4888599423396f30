// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where single pixels drown in noise, means of small blocks still show the stripe.
#pragma once

#include "core/image.h"

namespace lightstripe {

/// Means of factor x factor pixels, rounded; a rest at the right and lower border is left out. Block (x, y)
/// is centred at factor * (x, y) + (factor - 1) / 2.
template <class T>
void bin_image(ImageView<T> image, int factor, Image<T>& binned);

}  // namespace lightstripe
