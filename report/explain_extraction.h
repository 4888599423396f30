// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Why the thresholds of an image are what they are, in words.
#pragma once

#include <string>

#include "extraction/extract_stripes.h"
#include "io/images.h"

namespace lightstripe {

/// Several lines: the four grey levels, the decision about disturbing light, the thresholds, noise and scale.
std::string explain_extraction(const std::string& image, Channel channel, const ExtractionOptions& options,
                               const ExtractionResult& result);

}  // namespace lightstripe
