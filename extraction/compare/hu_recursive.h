// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Hu et al.'s method as described in Chen, Zhang, Sun 2013: Steger's test at every pixel, its Gaussian
// derivatives by recursive filters.
#pragma once

#include "core/image.h"
#include "extraction/compare/derivative_planes.h"

namespace lightstripe {

/// Needs about 50 bytes a pixel; its time does not depend on sigma.
template <class T>
void find_lines_hu(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                   WholeImageWorkspace& workspace, LineSet& lines);

}  // namespace lightstripe
