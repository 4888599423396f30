// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Steger, "An unbiased detector of curvilinear structures", PAMI 1998, over the whole image: the reference
// method.
#pragma once

#include "core/image.h"
#include "extraction/compare/derivative_planes.h"

namespace lightstripe {

/// Five separable filters, the line test at every pixel, hysteresis and linking; the linked points take a
/// second Newton step. Needs about 24 bytes a pixel.
template <class T>
void find_lines_steger(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                       WholeImageWorkspace& workspace, LineSet& lines);

}  // namespace lightstripe
