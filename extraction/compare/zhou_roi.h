// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Zhou et al.'s method as described in Chen, Zhang, Sun 2013: Otsu's threshold gives the stripes' pixels,
// these are dilated to a region of interest, and Steger's test runs inside it only.
#pragma once

#include "core/image.h"
#include "extraction/compare/derivative_planes.h"

namespace lightstripe {

/// `threshold`: Otsu's, grey levels; a pixel above it, and what lies within sigma of one, is tested.
template <class T>
void find_lines_zhou(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                     double threshold, WholeImageWorkspace& workspace, LineSet& lines);

}  // namespace lightstripe
