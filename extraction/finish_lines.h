// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The last part of an extraction: from lines that were found and judged to points in their final places, each
// with its error.
#pragma once

#include "core/image.h"
#include "extraction/options.h"
#include "extraction/workspace.h"

namespace lightstripe {

/// Of all lines of `workspace.groups`, in this order: what they tell together of the scatter of the image's
/// rows, places weighed anew where the light has grain, errors, ends, crossings, bends, smoothing, asymmetry.
/// `noise`: grey levels, of one pixel.
template <class T>
void finish_lines(ImageView<T> image, const ExtractionOptions& options, double noise,
                  ExtractionWorkspace& workspace);

}  // namespace lightstripe
