// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The derivatives of a whole image, and the lines in them: what the methods share that look at every pixel.
#pragma once

#include "core/image.h"
#include "extraction/compare/link_points.h"
#include "extraction/follow/ridge_limits.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

struct DerivativePlanes {
  Image<float> dx, dy, dxx, dxy, dyy;  ///< grey levels per px^order
};

/// Scratch memory of whole-image methods, kept from frame to frame.
struct WholeImageWorkspace {
  DerivativePlanes planes;
  Image<float> input, filtered, transposed;
  LinePointMap map;
};

/// Steger's test at every pixel of the planes, hysteresis and linking; the linked points take a second Newton
/// step in the image.
template <class T>
void find_lines_in_planes(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                          WholeImageWorkspace& workspace, LineSet& lines);

}  // namespace lightstripe
