// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measure_references.h"

#include <fmt/format.h>

#include "core/error.h"
#include "io/rig_file.h"
#include "measure/track_gauge.h"

namespace lightstripe {
namespace {

ReferenceShape nominal_of(const MeasureArguments& arguments, const MeasureInput& input,
                          const MeasureOptions& options) {
  if (arguments.nominal != "auto") return read_reference(arguments.nominal, arguments.kind);
  if (arguments.kind == ObjectKind::kWheel)
    throw Error("--nominal auto", "tells rails apart, not wheels", "name the wheel's outline");
  const IdentifiedRail found = identify_rail(input.profiles, options.registration);
  say(arguments.common, "rail: " + found.name);
  if (!found.also.empty())
    warn(
        fmt::format("{} cannot be told from {}: they differ in the head only, which wears; name the right "
                    "one with --nominal",
                    found.name, fmt::join(found.also, ", ")));
  return read_reference(found.name, arguments.kind);
}

Baseline read_baseline(const MeasureArguments& arguments, const ReferenceShape& nominal,
                       const MeasureOptions& options) {
  const MeasureInput earlier = read_measure_input(arguments.baseline, arguments.kind);
  return Baseline(earlier.profiles, nominal, earlier.prior, options.registration, arguments.baseline);
}

double place_between(const MeasureArguments& arguments, const MeasureInput& input) {
  if (arguments.kind != ObjectKind::kRail || !arguments.baseline.empty() || arguments.nominal == "auto")
    throw Error("--rails two", "is for rails against named outlines", "leave --baseline and auto out");
  const auto between = place_between_rails(input.profiles);
  if (!between)
    throw Error(arguments.profiles,
                "shows one rail only: its points leave no hole of 300 mm across the track",
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

MeasureReferences::MeasureReferences(const MeasureArguments& arguments, const MeasureInput& input,
                                     const MeasureOptions& options)
    : nominal_(nominal_of(arguments, input, options)) {
  if (!arguments.two_rails && !arguments.nominal_right.empty())
    throw Error("--nominal-right", "is the second of two rails", "add --rails two");
  if (arguments.two_rails) {
    between_u_ = place_between(arguments, input);
    if (!arguments.nominal_right.empty()) right_ = read_reference(arguments.nominal_right, arguments.kind);
    if (!arguments.rig.empty()) {
      const double sigma = read_rig(arguments.rig).quality.section_absolute_sigma_mm;
      if (sigma > 0) rig_sigma_mm_ = sigma;
    }
  }
  if (!arguments.baseline.empty()) baseline_ = read_baseline(arguments, nominal_, options);
}

const ReferenceShape& MeasureReferences::at(double travel) const {
  const ReferenceShape* const earlier = baseline_ ? baseline_->at(travel) : nullptr;
  return earlier ? *earlier : nominal_;
}

MeasuredFrame MeasureReferences::measure(const Profile& profile, const MeasureInput& input,
                                         const MeasureOptions& options) const {
  if (between_u_) return measure_track(profile, {nominal_, right(), *between_u_, rig_sigma_mm_}, options);
  const MeasuredObject object{at(profile.travel), input.prior, input.wheel};
  if (baseline_ && baseline_->at(profile.travel) == nullptr)
    return without_reference(profile, object, options);
  return measure_profile(profile, object, options);
}

std::vector<std::string> MeasureReferences::extra_columns() const {
  return between_u_ ? track_extra_names() : extra_names(nominal_.kind());
}

}  // namespace lightstripe
