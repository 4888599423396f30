// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What each section of a run is compared with: one outline, those of both rails of a track, or the sections
// of an earlier scan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/baseline.h"
#include "measure/measure_track.h"
#include "pipeline/calibration_errors.h"
#include "pipeline/measure_input.h"

namespace lightstripe {

struct ReferenceChoice {
  std::string nominal{};   ///< name or file of the new rail or wheel; empty: 60E1 or S1002; auto: what fits
  std::string baseline{};  ///< file of an earlier measurement as reference; empty: the nominal itself
  bool two_rails = false;  ///< each section shows both rails of a track
  std::string nominal_right{};  ///< two rails: name or file of the rail at -y; empty: as the other
  /// Two rails: the wheels, as a ConicityJob names them, whose conicity is wanted; empty: none.
  std::string wheelset{}, wheelset_right{};
  ConicityOptions conicity{};  ///< its gauge is not looked at
};

class MeasureReferences {
 public:
  /// `errors`: of the calibration that the sections were made with. An Error where the choice asks for what
  /// the sections do not show (a track), or a file is not usable.
  MeasureReferences(const ReferenceChoice& choice, const MeasureInput& input, const MeasureOptions& options,
                    const CalibrationErrors& errors);

  /// An earlier scan was given whose rig is not known: what its calibration errs by does not count.
  bool baselines_error_is_missing() const { return baselines_error_is_missing_; }
  /// What a section is drawn with, too.
  const ReferenceShape& at(double travel) const;
  /// Of the other rail, if there are two.
  const ReferenceShape& right() const { return right_ ? *right_ : nominal_; }
  /// What `auto` has found.
  const std::optional<IdentifiedRail>& identified() const { return identified_; }

  /// As if the calibration were without error.
  MeasuredFrame measure_plain(const Profile& profile, const MeasureInput& input,
                              const MeasureOptions& options) const;
  /// `plain`, which is measure_plain() of this profile, with what the calibration's errors do to it.
  MeasuredFrame with_errors(const MeasuredFrame& plain, const Profile& profile, const MeasureInput& input,
                            const MeasureOptions& options) const;
  /// Columns behind `status`.
  std::vector<std::string> extra_columns() const;

 private:
  /// What a section is measured with, as it is or under one of the calibration's errors.
  struct Standards {
    const Baseline* baseline;
    const ReferenceWheelset* wheelset;
  };
  /// As if the calibration were without error.
  MeasuredFrame measure_seen(const Profile& profile, const MeasureInput& input, const MeasureOptions& options,
                             const Standards& standards) const;
  void take_baseline(const std::string& file, const MeasureOptions& options);

  std::optional<IdentifiedRail> identified_;
  ReferenceShape nominal_;
  std::optional<ReferenceShape> right_;
  std::optional<Baseline> baseline_;
  /// Under each error of its own rig's calibration; where that is the scan's rig, both err at once.
  std::vector<Baseline> bent_baselines_;
  bool same_rig_ = false, baselines_error_is_missing_ = false;
  std::optional<double> between_u_;  ///< two rails: where they part
  CalibrationErrors errors_;
  std::optional<ReferenceWheelset> wheelset_, wheelset_without_sigma_;
};

}  // namespace lightstripe
