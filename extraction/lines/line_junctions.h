// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where a line was bridged over a crossing or a spot: both sides further out say where it runs through.
#pragma once

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// The last points before a bridge are already drawn aside by what is crossed, and a bridge that begins with
/// them is bent. One parabola through both sides a little further out replaces the bridge, and the points
/// beside it that lie off the parabola, which are then flagged as bridged too. Nothing is done where the
/// parabola does not meet both sides within their sigma_px, or where it leaves the light.
template <class T>
void mend_junctions(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines);

}  // namespace lightstripe
