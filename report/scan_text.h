// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The result of a reconstruction in sentences.
#pragma once

#include <filesystem>

#include "pipeline/reconstruct_job.h"
#include "report/message.h"

namespace lightstripe {

/// What was skipped or left out, and where the result is usable what was made of how many frames. `cloud`:
/// the file that was asked for.
Messages describe_scan(const ReconstructResult& result, const std::filesystem::path& cloud);

}  // namespace lightstripe
