// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// measure.html: one file, no network. What was measured along the track, the worst places, sections drawn.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/measure_job.h"

namespace lightstripe {

struct MeasureReportPlaces {
  std::filesystem::path page;       ///< where the text will be written: links are seen from there
  std::filesystem::path scan_file;  ///< of the sections: its pictures are shown and linked to; may be empty
  std::string view;                 ///< link to the page that shows the cloud; may be empty
};

std::string measure_report_html(const MeasureJob& job, const MeasureResult& result,
                                const MeasureReportPlaces& places);

}  // namespace lightstripe
