// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where a line leaves the picture. The light goes on there, but the kernels see the last row of pixels again
// and again, shifted along the line: its noise counts many times, and a wrong direction draws the points
// aside, in broad clipped bars most of all.
#pragma once

#include "core/image.h"
#include "core/stripe.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Whether a point lies at most `reach` px from the border of the image.
template <class T>
bool is_near_border(ImageView<T> image, const StripePoint& p, double reach) {
  return p.x < reach || p.y < reach || p.x > image.width - 1 - reach || p.y > image.height - 1 - reach;
}

/// Adds to `lines.systematic` how far the points of which the kernels see the border lie off the parabola
/// through the line further in, beyond what the errors of both explain.
template <class T>
void find_border_errors(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines);

}  // namespace lightstripe
