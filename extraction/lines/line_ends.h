// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The last points of a line: half of what the kernels see there is dark, and a stripe that is cut off
// obliquely is drawn aside.
#pragma once

#include <vector>

#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"
#include "extraction/lines/local_fit.h"

namespace lightstripe {

/// The weaker a point is relative to the interior of the line, the larger its error. Each such point is
/// averaged with the continuation of the line from further in (a parabola), each weighted by its variance;
/// sigma_px follows. `places` is scratch memory.
void mend_line_ends(const DerivativeKernels& kernels, LineSet& lines, std::vector<LocalFitPoint>& places);

}  // namespace lightstripe
