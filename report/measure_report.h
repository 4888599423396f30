// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// measure.html: one file, no network. What was measured along the track, worst places first, sections drawn.
#pragma once

#include <string>
#include <vector>

#include "measure/limits.h"
#include "pipeline/measure_references.h"

namespace lightstripe {

struct MeasureReport {
  const MeasureArguments& arguments;
  const std::vector<Profile>& profiles;
  const MeasureOutcome& outcome;
  const MeasureReferences& references;
  const Limits& limits;
  double max_overlap_gap_mm = 0;
};

/// Where the arguments name a scan, its pictures are linked to, as seen from the report's place.
std::string measure_report_html(const MeasureReport& report);

}  // namespace lightstripe
