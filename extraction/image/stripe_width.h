// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Estimates the stripe width, which sets the kernel scale when the user gives none.
#pragma once

#include <optional>

#include "core/image.h"

namespace lightstripe {

/// Full width 2w of the bright bars, px: the median over the brighter local maxima of every few rows and
/// columns, each crossed by its row and its column. Nothing where there is no maximum brighter than `level`
/// that rises over its surroundings by `contrast` grey levels.
template <class T>
std::optional<double> estimate_stripe_width(ImageView<T> image, double level, double contrast);

}  // namespace lightstripe
