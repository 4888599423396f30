// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The last step of an extraction: lines in the workspace -> stripes of the result.
#pragma once

#include "extraction/result.h"
#include "extraction/workspace.h"

namespace lightstripe {

/// As many stripes as needed; the memory of points that are not needed now waits in the workspace.
void resize_stripes(std::size_t count, ExtractionWorkspace& w, std::vector<Stripe>& stripes);

/// The lines of all scales, longest first, with growing x or y; at most `max_lines`, 0: all. `origin`: of the
/// looked-at region in the image. The stripes keep their memory from picture to picture.
void hand_over(ExtractionWorkspace& w, int max_lines, const PixelPlace& origin, ExtractionResult& result);

}  // namespace lightstripe
