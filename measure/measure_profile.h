// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// One frame from profile to a row of measurements.csv.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/profile.h"
#include "measure/conicity.h"
#include "measure/measure_rail.h"
#include "measure/measure_wheel.h"
#include "measure/overlap_gap.h"

namespace lightstripe {

struct MeasureOptions {
  RegistrationOptions registration;
  RailOptions rail;
  WheelOptions wheel;
  /// Estimates that the user needs, by name: a row is "ok" where they are known. Empty: all that belong to a
  /// complete measurement.
  std::vector<std::string> required = {};
  double max_overlap_gap_mm = 0.1;  ///< between two sensors on the head: above, the calibration is in doubt
};

struct NamedEstimate {
  std::string name;
  Estimate estimate;
};

struct MeasuredFrame {
  std::int64_t frame = 0;
  double travel = 0;
  std::string nominal;
  std::vector<NamedEstimate> estimates;  ///< the table's columns, in order
  std::vector<NamedEstimate> extras;     ///< behind `status`
  Registration registration;
  std::optional<Registration> right_registration;  ///< of the other rail, see measure_track()
  std::vector<ConicityRow> conicity;               ///< of a reference wheelset on a track, if asked for
  std::string status;                              ///< "ok" or why not
};

/// What all frames of a run have in common.
struct MeasuredObject {
  const ReferenceShape& reference;
  SectionPrior prior;
  WheelSectionKind wheel;  ///< of a rail: not looked at
};

/// A section with too few points, or one that does not fit, gives a row of unknowns with the reason.
MeasuredFrame measure_profile(const Profile& profile, const MeasuredObject& object,
                              const MeasureOptions& options);

/// Whether at least one of the estimates that the user needs is known.
bool any_known(const MeasuredFrame& row, const MeasureOptions& options);

/// Of the kind of the table, empty: for headers.
std::vector<std::string> estimate_names(ObjectKind kind);
std::vector<std::string> extra_names(ObjectKind kind);

}  // namespace lightstripe
