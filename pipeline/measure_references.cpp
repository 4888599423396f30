// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measure_references.h"

#include <fmt/format.h>

#include "core/error.h"
#include "measure/section_bends.h"
#include "measure/track_gauge.h"
#include "pipeline/conicity_job.h"

namespace lightstripe {
namespace {

std::optional<IdentifiedRail> identify(const ReferenceChoice& choice, const MeasureInput& input,
                                       const MeasureOptions& options) {
  if (choice.nominal != "auto") return std::nullopt;
  if (input.kind == ObjectKind::kWheel)
    throw Error("--nominal auto", "tells rails apart, not wheels", "name the wheel's outline");
  return identify_rail(input.profiles, options.registration);
}

Baseline read_baseline(const std::string& file, const ReferenceShape& nominal,
                       const MeasureOptions& options) {
  const MeasureInput earlier = read_measure_input(file, nominal.kind());
  return Baseline(earlier.profiles, nominal, earlier.prior, options.registration, file);
}

ReferenceWheelset read_wheelset(const ReferenceChoice& choice) {
  ConicityJob job;
  const std::string& right = choice.wheelset_right.empty() ? choice.wheelset : choice.wheelset_right;
  return {{read_rolling_wheel(choice.wheelset, job, {}), read_rolling_wheel(right, job, {})},
          choice.conicity};
}

double place_between(const ReferenceChoice& choice, const MeasureInput& input) {
  if (input.kind != ObjectKind::kRail || !choice.baseline.empty() || choice.nominal == "auto")
    throw Error("--rails two", "is for rails against named outlines", "leave --baseline and auto out");
  const auto between = place_between_rails(input.profiles);
  if (!between)
    throw Error(input.file, "shows one rail only: its points leave no hole of 300 mm across the track",
                "leave --rails two out");
  return *between;
}

/// A section that nothing is known to compare with.
MeasuredFrame without_reference(const Profile& profile, const MeasuredObject& object,
                                const MeasureOptions& options) {
  Profile empty;
  empty.frame = profile.frame, empty.travel = profile.travel;
  MeasuredFrame row = measure_profile(empty, object, options);
  row.status = row.registration.reason = "the baseline has no section near this travel";
  for (auto* list : {&row.estimates, &row.extras})
    for (NamedEstimate& one : *list) one.estimate.reason = row.status;
  return row;
}

}  // namespace

MeasureReferences::MeasureReferences(const ReferenceChoice& choice, const MeasureInput& input,
                                     const MeasureOptions& options, const CalibrationErrors& errors)
    : identified_(identify(choice, input, options)),
      nominal_(read_reference(identified_ ? identified_->name : choice.nominal, input.kind)),
      errors_(errors) {
  if (!choice.two_rails && !choice.nominal_right.empty())
    throw Error("--nominal-right", "is the second of two rails", "add --rails two");
  if (!choice.two_rails && !choice.wheelset.empty())
    throw Error("--wheelset", "runs on a track", "add --rails two, or use `lightstripe conicity` for a pair");
  if (choice.two_rails) {
    if (!choice.wheelset.empty()) {
      wheelset_ = wheelset_without_sigma_ = read_wheelset(choice);
      wheelset_without_sigma_->options.draws = 0;
    }
    between_u_ = place_between(choice, input);
    if (!choice.nominal_right.empty()) right_ = read_reference(choice.nominal_right, input.kind);
  }
  if (!choice.baseline.empty()) baseline_ = read_baseline(choice.baseline, nominal_, options);
}

const ReferenceShape& MeasureReferences::at(double travel) const {
  const ReferenceShape* const earlier = baseline_ ? baseline_->at(travel) : nullptr;
  return earlier ? *earlier : nominal_;
}

MeasuredFrame MeasureReferences::measure(const Profile& profile, const MeasureInput& input,
                                         const MeasureOptions& options) const {
  return measure_with_errors(errors_.bends.bends.size(), [&](std::optional<std::size_t> bend) {
    if (!bend) return measure_seen(profile, input, options, wheelset_ ? &*wheelset_ : nullptr);
    return measure_seen(bent(profile, errors_.bends, *bend), input, options,
                        wheelset_ ? &*wheelset_without_sigma_ : nullptr);
  });
}

MeasuredFrame MeasureReferences::measure_seen(const Profile& profile, const MeasureInput& input,
                                              const MeasureOptions& options,
                                              const ReferenceWheelset* wheelset) const {
  if (between_u_)
    return measure_track(profile, {nominal_, right(), *between_u_, errors_.place_sigma_mm, wheelset},
                         options);
  const MeasuredObject object{at(profile.travel), input.prior, input.wheel};
  if (baseline_ && baseline_->at(profile.travel) == nullptr)
    return without_reference(profile, object, options);
  return measure_profile(profile, object, options);
}

std::vector<std::string> MeasureReferences::extra_columns() const {
  return between_u_ ? track_extra_names(wheelset_.has_value()) : extra_names(nominal_.kind());
}

}  // namespace lightstripe
