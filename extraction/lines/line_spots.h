// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How far a line's centre may be off where a clipped bright spot lies on it (a reflection, a spark): where
// the line runs within the white is not to be seen.
#pragma once

#include <vector>

#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Adds to `lines.systematic`, after the ends are mended: over a stretch that is wider than its line and
/// clipped, while the line itself is not, the centre may lie anywhere in what the stretch is wider by; 1
/// sigma is that over sqrt(12). `values` is scratch memory.
void find_spot_errors(LineSet& lines, std::vector<float>& values);

/// Adds to `lines.systematic` what pixels of `bin` x `bin` of the image's hide of clipped points, followed
/// there by kernels of `sigma` px: the flanks of a clipped bar are so steep that means over a few pixels no
/// longer tell where they are. Most along the pixels, where all rows share one error.
void find_binning_errors(double sigma, int bin, LineSet& lines);

}  // namespace lightstripe
