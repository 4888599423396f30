// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The grey-value centre: in every column (row) the centroid of each bright run. Fast and simple, for stripes
// that cross the columns (rows) steeply on a dark background.
#pragma once

#include "core/image.h"
#include "extraction/direction_guided.h"
#include "extraction/kernels.h"
#include "extraction/line_set.h"

namespace lightstripe {

/// Columns are taken where the bright pixels' runs are shorter down the columns than along the rows, else
/// rows. Runs of neighbouring columns that touch make one line; the grey value over T_l weighs.
template <class T>
void find_lines_centroid(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                         LineSet& lines);

}  // namespace lightstripe
