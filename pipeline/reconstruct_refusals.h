// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a scan that gave nothing is told, and what helps.
#pragma once

#include <string>

#include "pipeline/reconstruct_job.h"

namespace lightstripe {

/// An Error where no picture could be used, or, with `strict`, where two pictures have one number.
void refuse_unusable_pictures(const ReconstructJob& job, const ReconstructResult& result);

/// Why the result is not usable, and what to do; empty: it is.
std::string why_not_usable(const ReconstructResult& result);

}  // namespace lightstripe
