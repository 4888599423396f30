// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sections on disk -> measurements on disk.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "measure/limits.h"
#include "measure/run_out.h"

namespace lightstripe {

struct MeasureArguments {
  CommonOptions common;
  std::string profiles;  ///< profiles.csv, or a file of the railway world
  ObjectKind kind = ObjectKind::kRail;
  std::string nominal;        ///< empty: 60E1 or S1002; auto: the rail that fits
  std::string baseline;       ///< an earlier measurement as reference; empty: the nominal outline itself
  bool two_rails = false;     ///< each section shows both rails of a track
  std::string nominal_right;  ///< of the rail at -y; empty: as the other
  std::string scan;           ///< the report links to its pictures; empty: no links
  std::string limits;         ///< YAML; empty: none
  std::string report;         ///< empty: not written
  std::vector<std::int64_t> plot;
  std::string export_folder, export_format = "miniprof";
  std::string rig;                   ///< empty: the diameter gets no sigma
  std::vector<std::string> require;  ///< names of the estimates that the user needs; empty: all
  std::optional<double> max_overlap_gap_mm;
  Overrides rail, wheel, registration, limit;
};

struct MeasureOutcome {
  std::vector<MeasuredFrame> rows;
  std::vector<std::string> verdicts;
  std::vector<std::string> extra_columns;  ///< names of the rows' extras
  std::optional<RunOut> run_out;           ///< of a wheel
  int num_ok = 0;
  int num_known = 0;  ///< rows where at least one estimate that the user needs is known
};

/// Reads, measures and writes.
MeasureOutcome measure_profiles(const MeasureArguments& arguments);

}  // namespace lightstripe
