// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The result of a measurement in sentences.
#pragma once

#include "pipeline/measure_job.h"
#include "report/message.h"

namespace lightstripe {

/// Lowest, mean and highest of each quantity, run-out, why frames were not measured.
Messages describe_measurement(const MeasureJob& job, const MeasureResult& result);

}  // namespace lightstripe
