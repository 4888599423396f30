// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// image -> stripes: the one door to every extraction method.
#pragma once

#include "core/image.h"
#include "extraction/options.h"
#include "extraction/result.h"

namespace lightstripe {

/// Buffers that a caller keeps between frames of a sequence (one a thread), so that nothing is allocated a
/// frame. Defined in extraction/workspace.h.
struct ExtractionWorkspace;

/// An empty or dark image gives no stripes. Options out of their range: Error naming the option.
ExtractionResult extract_stripes(ImageView8 image, const ExtractionOptions& options = {});
ExtractionResult extract_stripes(ImageView16 image, const ExtractionOptions& options = {});

/// The same into memory that is kept: workspace and result may come from any earlier call.
void extract_stripes(ImageView8 image, const ExtractionOptions& options, ExtractionWorkspace& workspace,
                     ExtractionResult& result);
void extract_stripes(ImageView16 image, const ExtractionOptions& options, ExtractionWorkspace& workspace,
                     ExtractionResult& result);

}  // namespace lightstripe
