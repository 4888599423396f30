// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Word of the rig beside a table of sections (profiles.csv.run.yaml): whoever measures the sections finds
// what the rig's calibration errs by, without being told.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/rig.h"

namespace lightstripe {

/// A rig file as it was when sections were made with it.
struct RigPlace {
  std::filesystem::path file;
  std::string sha256;
};

/// The file, if it still holds this rig; nothing where it is gone or holds another one.
std::optional<RigPlace> place_of_rig(const std::filesystem::path& file, const Rig& rig);

/// Writes <table>.run.yaml: command, inputs, length and check sum of the table, and where its rig is, or why
/// none is named (`without_rig`).
void write_sections_record(const std::filesystem::path& table, const std::string& command,
                           const std::vector<std::filesystem::path>& inputs,
                           const std::optional<RigPlace>& rig, const std::string& without_rig);

/// What a table's record says of its rig.
struct RecordedRig {
  std::optional<RigPlace> rig;  ///< the file may be gone or hold another one by now
  std::string why_not;          ///< why there is none; empty: the table has no record at all
};
RecordedRig recorded_rig(const std::filesystem::path& table);

/// The rig whose calibration counts in what is measured of a table.
struct RigOfSections {
  std::filesystem::path file;  ///< empty: none is known
  bool by_record = false;      ///< found by the table's record, not named by the user
  std::string warning;         ///< what is missing or does not fit, and which option helps
};

/// The rig that the user has `given`, else the one that the table's record names, if it is still that one.
RigOfSections rig_of_sections(const std::filesystem::path& table, const std::filesystem::path& given);

}  // namespace lightstripe
