// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measure_references.h"

#include <fmt/format.h>

#include <utility>

#include "core/error.h"
#include "measure/section_bends.h"
#include "measure/track_gauge.h"
#include "parallel/parallel.h"
#include "pipeline/conicity_job.h"
#include "pipeline/rig_of_sections.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

std::optional<IdentifiedRail> identify(const ReferenceChoice& choice, const MeasureInput& input,
                                       const MeasureOptions& options) {
  if (choice.nominal != "auto") return std::nullopt;
  if (input.kind == ObjectKind::kWheel)
    throw Error("--nominal auto", "tells rails apart, not wheels", "name the wheel's outline");
  return identify_rail(input.profiles, options.registration);
}

bool same_contents(const std::filesystem::path& a, const std::filesystem::path& b) {
  return facts_of(a).sha256 == facts_of(b).sha256;
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
  if (!choice.baseline.empty()) take_baseline(choice.baseline, options);
}

const ReferenceShape& MeasureReferences::at(double travel) const {
  const ReferenceShape* const earlier = baseline_ ? baseline_->at(travel) : nullptr;
  return earlier ? *earlier : nominal_;
}

void MeasureReferences::take_baseline(const std::string& file, const MeasureOptions& options) {
  const MeasureInput earlier = read_measure_input(file, nominal_.kind());
  const auto laid_on_nominal = [&](const std::vector<Profile>& profiles) {
    return Baseline(profiles, nominal_, earlier.prior, options.registration, file);
  };
  baseline_ = laid_on_nominal(earlier.profiles);
  if (!errors_.counted()) return;
  const RigOfSections rig = rig_of_sections(file, {});
  same_rig_ = !rig.file.empty() && same_contents(rig.file, errors_.rig_file);
  const SectionBends bends =
      same_rig_ ? errors_.bends : calibration_errors(rig.file, file, earlier.profiles).bends;
  baselines_error_is_missing_ = bends.bends.empty();
  std::vector<std::optional<Baseline>> laid(bends.bends.size());
  parallel_for(laid.size(), [&](std::size_t bend) {
    std::vector<Profile> profiles = earlier.profiles;
    for (Profile& profile : profiles) profile = bent(profile, bends, bend);
    laid[bend] = laid_on_nominal(profiles);
  });
  for (auto& baseline : laid) bent_baselines_.push_back(*std::move(baseline));
}

MeasuredFrame MeasureReferences::measure_plain(const Profile& profile, const MeasureInput& input,
                                               const MeasureOptions& options) const {
  return measure_seen(profile, input, options,
                      {baseline_ ? &*baseline_ : nullptr, wheelset_ ? &*wheelset_ : nullptr});
}

MeasuredFrame MeasureReferences::with_errors(const MeasuredFrame& plain, const Profile& profile,
                                             const MeasureInput& input, const MeasureOptions& options) const {
  const std::size_t own = errors_.bends.bends.size(), of_baseline = same_rig_ ? 0 : bent_baselines_.size();
  const Baseline* const baseline = baseline_ ? &*baseline_ : nullptr;
  return measure_with_errors(own + of_baseline, [&](std::optional<std::size_t> error) {
    if (!error) return plain;
    Standards standards{baseline, wheelset_ ? &*wheelset_without_sigma_ : nullptr};
    if (same_rig_ || *error >= own) standards.baseline = &bent_baselines_[same_rig_ ? *error : *error - own];
    return measure_seen(*error < own ? bent(profile, errors_.bends, *error) : profile, input, options,
                        standards);
  });
}

MeasuredFrame MeasureReferences::measure_seen(const Profile& profile, const MeasureInput& input,
                                              const MeasureOptions& options,
                                              const Standards& standards) const {
  if (between_u_)
    return measure_track(
        profile, {nominal_, right(), *between_u_, errors_.place_sigma_mm, standards.wheelset}, options);
  const ReferenceShape* const earlier = standards.baseline ? standards.baseline->at(profile.travel) : nullptr;
  const MeasuredObject object{earlier ? *earlier : nominal_, input.prior, input.wheel};
  if (standards.baseline && !earlier) return without_reference(profile, object, options);
  return measure_profile(profile, object, options);
}

std::vector<std::string> MeasureReferences::extra_columns() const {
  return between_u_ ? track_extra_names(wheelset_.has_value()) : extra_names(nominal_.kind());
}

}  // namespace lightstripe
