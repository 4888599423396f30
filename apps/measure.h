// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sections on disk -> measurements on disk.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "measure/limits.h"

namespace lightstripe {

struct MeasureArguments {
  CommonOptions common;
  std::string profiles;  ///< profiles.csv, or a file of the railway world
  ObjectKind kind = ObjectKind::kRail;
  std::string nominal;  ///< empty: 60E1 or S1002; auto: the rail that fits
  std::string limits;   ///< YAML; empty: none
  std::string report;   ///< empty: not written
  std::vector<std::int64_t> plot;
  std::string export_folder, export_format = "miniprof";
  std::string rig;  ///< empty: the diameter gets no sigma
  std::optional<double> max_overlap_gap_mm;
  Overrides rail, wheel, registration, limit;
};

struct MeasureOutcome {
  std::vector<MeasuredFrame> rows;
  std::vector<std::string> verdicts;
  int num_ok = 0;
};

/// Reads, measures and writes.
MeasureOutcome measure_profiles(const MeasureArguments& arguments);

}  // namespace lightstripe
