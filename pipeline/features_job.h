// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Sections and a file of features on disk -> a table of measurements on disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/features.h"
#include "pipeline/calibration_errors.h"
#include "pipeline/rig_of_sections.h"

namespace lightstripe {

struct FeaturesJob {
  std::filesystem::path profiles, features;
  /// Whose calibration's error counts in the sigmas; empty: the one that the sections' record names.
  std::filesystem::path rig;
  std::filesystem::path table = "measurements.csv";
  std::vector<std::filesystem::path> other_outputs;  ///< what else is written: must not be an input either
  int threads = 0;                                   ///< 0: all cores
};

struct FeaturesResult {
  FeatureFile file;
  std::vector<Profile> profiles;
  std::vector<MeasuredFeatures> rows;
  std::vector<Estimate> along;
  std::filesystem::path along_table;  ///< where `along` was written; empty: nowhere
  int num_complete = 0;               ///< rows without an empty cell
  RigOfSections rig;
  CalibrationErrors calibration;
};

/// Reads, measures and writes the table, the run's record (<table>.run.yaml), and `<table>_along.csv` where
/// the file asks for that.
FeaturesResult measure_features_job(const FeaturesJob& job);

/// frame,travel, each quantity with its _sigma, status, verdict, missing (which cells are empty and
/// why), calibration_error (see calibration_word()).
std::string features_table(const FeaturesResult& result);

}  // namespace lightstripe
