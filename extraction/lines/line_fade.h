// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How far a line's centre may be off where its light fades or is stained: the brightness then usually changes
// across the line as well.
#pragma once

#include <vector>

#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Sets `lines.fading`. A stripe of standard deviation s across whose brightness changes by a factor
/// exp(g) a pixel has its centre g s^2 aside. Only the change along the line is seen; that across it is taken
/// for half of that, 1 sigma, as far as it exceeds what the grain of the whole line does. `values` is scratch
/// memory.
void find_fade_errors(const DerivativeKernels& kernels, LineSet& lines, std::vector<float>& values);

}  // namespace lightstripe
