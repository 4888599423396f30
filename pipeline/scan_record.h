// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The end of a scan: its files take their names, and its record is written beside them.
#pragma once

#include "pipeline/scan_run.h"

namespace lightstripe {

/// Gives the finished or interrupted files their names and their records; `result` is complete but for
/// `partial_cloud`, which this sets. Without points nothing is left.
void close_output(const ScanRun& run, ScanOutput& output, ReconstructResult& result);

}  // namespace lightstripe
