// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// measurements as a workbook (.xlsx): the table with names and units, and a chart of each quantity.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/limits.h"
#include "measure/measure_profile.h"

namespace lightstripe {

/// One row a frame, the columns of measurements.csv; what is not known is an empty cell. On the sheet
/// "charts" each quantity that is known in two frames at least, along the travel, with its limits.
void write_measurement_workbook(const std::filesystem::path& path, const std::vector<MeasuredFrame>& rows,
                                ObjectKind kind, const std::vector<std::string>& extras,
                                const std::vector<std::string>& verdicts, const Limits& limits,
                                const std::string& calibration_error);

}  // namespace lightstripe
