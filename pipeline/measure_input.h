// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What `lightstripe measure` reads: sections of a scan or of a railway file, and what to compare them with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/profile.h"
#include "measure/measure_profile.h"

namespace lightstripe {

struct MeasureInput {
  int further_profiles = 0;  ///< of an .mpt: behind the first, not read
  std::string file;          ///< where it was read
  ObjectKind kind = ObjectKind::kRail;
  std::vector<Profile> profiles;
  SectionPrior prior;
  WheelSectionKind wheel;
};

/// profiles.csv, or one section from .ban .whl .mpt .prr .prw. A wheel's file keeps its own frame (back at 0,
/// upright); its DiameterTaperline, if there, gives the diameter.
MeasureInput read_measure_input(const std::string& path, ObjectKind kind);

/// A built-in outline, an outline file, or a recorded profile (baseline); empty: 60E1 or S1002.
ReferenceShape read_reference(const std::string& nominal, ObjectKind kind);

/// The built-in rail that fits some of the sections best; `also` names those that fit as well (they differ in
/// the head only). An Error if none fits.
struct IdentifiedRail {
  std::string name;
  std::vector<std::string> also;
};
IdentifiedRail identify_rail(const std::vector<Profile>& profiles, const RegistrationOptions& options);

std::string kind_name(ObjectKind kind);

}  // namespace lightstripe
