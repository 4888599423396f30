// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A recording that is still being written: its frames are done as they come.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "pipeline/scan_run.h"

namespace lightstripe {

/// Scans the frames of the run that the output does not have.
using ScanFrames = std::function<void(const ScanRun& run, ScanOutput& output)>;

/// Looks for new frames until the recording is over, nothing has come for idle_s, or a stop is asked for;
/// opens `output` with the first. Returns the last look at the recording. An Error where nothing that can be
/// used was recorded.
ScanRun scan_what_comes(const ReconstructJob& job, const ScanFrames& scan, const std::stop_token& stop,
                        std::optional<ScanOutput>& output);

}  // namespace lightstripe
