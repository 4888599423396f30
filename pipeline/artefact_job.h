// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe verify --artefact`: one scan or picture of a body of known size -> its error, a
// verdict, and the drift since the last check.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/rig.h"
#include "extraction/options.h"
#include "measure/artefact.h"
#include "pipeline/job.h"

namespace lightstripe {

struct ArtefactJob {
  std::filesystem::path input;     ///< a scan (YAML), or one picture
  std::filesystem::path rig_file;  ///< named in messages and in the run's record
  Rig rig;
  std::string sensor;  ///< that took the picture; empty: the rig's first
  ExtractionOptions extraction;
  ArtefactSpec spec;                                    ///< `section` follows from the input
  double size_sigma_mm = 0;                             ///< how well the body's own size is known
  double max_error_mm = 0;                              ///< 0: three sigma
  double max_drift_mm = 0;                              ///< against the last check; 0: not checked
  std::filesystem::path table = "artefact_checks.csv";  ///< grows by one row a check; empty: not kept
  std::vector<std::filesystem::path> other_outputs;     ///< what else is written: must not be an input either
  int threads = 0;                                      ///< 0 = all cores
};

/// One row of the table.
struct ArtefactCheck {
  std::string time;  ///< UTC, 2026-11-27T04:12:31Z
  std::string rig, input, artefact;
  double size_mm = 0, measured_mm = 0, error_mm = 0, sigma_mm = 0, scatter_mm = 0;
  std::int64_t points = 0;
  double limit_mm = 0;
  std::optional<double> drift_mm,
      drift_sigma_mm;   ///< against the row before of the same body; none: the first
  std::string verdict;  ///< pass or fail
};

struct ArtefactResult {
  std::optional<ArtefactCheck> check;  ///< nothing: the body was not found
  std::vector<ArtefactCheck> history;  ///< of the same body, this check the last
  double sheet_error_mm = 0;           ///< of a round body: what the sheet's thickness may take off, in sigma
  std::string not_usable;              ///< why the rig fails or cannot be judged; empty: it passes
  bool usable() const { return not_usable.empty(); }
};

/// Sigma of the error: the measurement's own scatter, the points' predicted sigma (with the rig's
/// section_shape_sigma_mm), which they may share, what the sheet's thickness does to a curved body, and the
/// body's own.
/// Appends the check to the table and writes <table>.run.yaml. An Error where a file is wrong.
ArtefactResult verify_artefact(const ArtefactJob& job, const ProgressCallback& progress = {},
                               const std::stop_token& stop = {});

/// Whether the input of a job is a scan; else it is a picture.
bool shows_scan(const std::filesystem::path& input);

/// The rows of a table of checks, oldest first.
std::vector<ArtefactCheck> read_artefact_checks(const std::filesystem::path& table);

}  // namespace lightstripe
