// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe measure`: sections on disk -> wear and dimensions of rails and wheels on disk.
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "measure/limits.h"
#include "measure/run_out.h"
#include "pipeline/job.h"
#include "pipeline/measure_input.h"
#include "pipeline/measure_references.h"
#include "pipeline/rig_of_sections.h"

namespace lightstripe {

enum class SectionFormat { kMiniProf, kSimpack };

struct MeasureJob {
  std::filesystem::path profiles;  ///< profiles.csv, or one section as .ban .whl .mpt .prr .prw
  ObjectKind kind = ObjectKind::kRail;
  ReferenceChoice reference;
  /// Rig file, for what the calibration errs by; empty: the one that the sections' record names.
  std::filesystem::path rig;
  MeasureOptions options;
  Limits limits;
  std::filesystem::path table = "measurements.csv";  ///< .csv or .xlsx; empty: not written
  std::filesystem::path conicity_table{};            ///< of each section's amplitudes; empty: not written
  std::filesystem::path export_folder;               ///< for the registered sections; empty: not written
  SectionFormat export_format = SectionFormat::kMiniProf;
  std::vector<std::filesystem::path> other_inputs, other_outputs;  ///< what else is read and written
  int threads = 0;                                                 ///< 0 = all cores
};

struct MeasureResult {
  MeasureInput input;  ///< the sections as they were read, one a row
  MeasureReferences references;
  std::vector<MeasuredFrame> rows;
  RigOfSections rig{};                       ///< whose calibration's error was looked for
  CalibrationErrors calibration{};           ///< what was found of it, and whether it counts in the sigmas
  std::vector<std::string> verdicts{};       ///< of each row against the limits: pass, fail, unknown or empty
  std::vector<std::string> extra_columns{};  ///< names of the rows' extras
  std::optional<RunOut> run_out{};           ///< of a wheel
  int num_ok = 0;     ///< rows in which everything that the user needs (options.required) is known
  int num_known = 0;  ///< rows in which something of it is known
  std::vector<std::string> warnings{};
  std::string not_usable{};  ///< why; empty: some row is known
  bool usable() const { return not_usable.empty(); }
};

/// Reads, measures and writes the table, the exported sections and the run's record (<table>.run.yaml). An
/// Error where a file is wrong, or a stop was asked for.
MeasureResult measure(const MeasureJob& job, const ProgressCallback& progress = {},
                      const std::stop_token& stop = {});

}  // namespace lightstripe
