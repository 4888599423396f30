// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// measure.html: one file, no network. What was measured along the track, worst places first, sections drawn.
#pragma once

#include <string>
#include <vector>

#include "measure/limits.h"

namespace lightstripe {

struct MeasureReport {
  const std::vector<Profile>& profiles;
  const std::vector<MeasuredFrame>& rows;
  const std::vector<std::string>& verdicts;
  const ReferenceShape& reference;
  const Limits& limits;
  double max_overlap_gap_mm = 0;
  std::string source;  ///< the input's name
};

std::string measure_report_html(const MeasureReport& report);

}  // namespace lightstripe
