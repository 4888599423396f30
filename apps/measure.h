// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sections on disk -> measurements on disk.
#pragma once

#include <string>
#include <vector>

#include "apps/command.h"
#include "measure/limits.h"

namespace lightstripe {

struct MeasureArguments {
  CommonOptions common;
  std::string profiles;  ///< profiles.csv, or a file of the railway world
  ObjectKind kind = ObjectKind::kRail;
  std::string nominal;   ///< empty: 60E1 or S1002
  std::string baseline;  ///< a section to compare with instead of a nominal outline
  std::string limits;    ///< YAML; empty: none
  std::string report;    ///< empty: not written
  std::vector<std::int64_t> plot;
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
