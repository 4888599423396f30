// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a rig's calibration errs by in sections that were made with it, as far as rig.yaml tells.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/profile.h"
#include "core/section_bends.h"

namespace lightstripe {

struct CalibrationErrors {
  std::filesystem::path rig_file;           ///< empty: none is known
  SectionBends bends;                       ///< that hold for these sections
  std::optional<double> place_sigma_mm;     ///< of a point's place: stands for the bends where there are none
  std::optional<double> axis_sigma_mm;      ///< of the distance from a rotary rig's axis, likewise
  std::string why_not = "no rig is known";  ///< why the bends do not count; empty: they do
  bool counted() const { return why_not.empty(); }
};

/// `table`: where the sections come from; those of a railway file lie in no rig's frame. Without a rig file
/// nothing is known.
CalibrationErrors calibration_errors(const std::filesystem::path& rig_file,
                                     const std::filesystem::path& table,
                                     const std::vector<Profile>& sections);

/// For the record of a run: one line of YAML.
std::string calibration_yaml(const CalibrationErrors& errors);
/// For a table's column `calibration_error`: "counted" or "not counted".
std::string calibration_word(const CalibrationErrors& errors);

}  // namespace lightstripe
