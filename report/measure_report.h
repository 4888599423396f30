// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// measure.html: one file, no network. What was measured along the track, worst places first, sections drawn.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/measure_job.h"

namespace lightstripe {

/// `page` is where the text will be written, and `scan_file` (may be empty) names the scan that the sections
/// are of: its pictures are linked to, as seen from the page.
std::string measure_report_html(const MeasureJob& job, const MeasureResult& result,
                                const std::filesystem::path& page,
                                const std::filesystem::path& scan_file = {});

}  // namespace lightstripe
