// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What each section of a run is compared with: one outline, those of both rails of a track, or the sections
// of an earlier scan.
#pragma once

#include <optional>

#include "apps/measure.h"
#include "measure/baseline.h"
#include "measure/measure_track.h"
#include "pipeline/measure_input.h"

namespace lightstripe {

class MeasureReferences {
 public:
  /// An Error where the arguments ask for what the sections do not show (a track), or a file is not usable.
  MeasureReferences(const MeasureArguments& arguments, const MeasureInput& input,
                    const MeasureOptions& options);

  /// What a section is drawn with, too.
  const ReferenceShape& at(double travel) const;
  /// Of the other rail, if there are two.
  const ReferenceShape& right() const { return right_ ? *right_ : nominal_; }

  MeasuredFrame measure(const Profile& profile, const MeasureInput& input,
                        const MeasureOptions& options) const;
  /// Columns behind `status`.
  std::vector<std::string> extra_columns() const;

 private:
  ReferenceShape nominal_;
  std::optional<ReferenceShape> right_;
  std::optional<Baseline> baseline_;
  std::optional<double> between_u_;  ///< two rails: where they part
  std::optional<double> rig_sigma_mm_;
};

}  // namespace lightstripe
