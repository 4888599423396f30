// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

/// A wheel is measured completely without these: the section may end before the outer face, a linear scan
/// knows no axis.
bool optional_estimate(const std::string& name) { return name == "rim_width" || name == "diameter"; }

bool is_required(const std::string& name, const MeasureOptions& options) {
  if (options.required.empty()) return !optional_estimate(name);
  return std::find(options.required.begin(), options.required.end(), name) != options.required.end();
}

std::string status_of(const MeasuredFrame& row, const MeasureOptions& options) {
  // Of a head alone some quantities are known: whoever needs only those gets them.
  if (!row.registration.usable() && (options.required.empty() || !row.registration.head_fits))
    return row.registration.reason;
  for (const NamedEstimate& one : row.estimates)
    if (!one.estimate.value && is_required(one.name, options)) return one.name + ": " + one.estimate.reason;
  for (const NamedEstimate& one : row.extras)
    if (!options.required.empty() && !one.estimate.value && is_required(one.name, options))
      return one.name + ": " + one.estimate.reason;
  for (const NamedEstimate& one : row.extras)
    if (one.name == "overlap_gap" && one.estimate.value &&
        std::abs(*one.estimate.value) > options.max_overlap_gap_mm)
      return fmt::format("overlap gap {:.3f} mm, limit {:.3f}: check the calibration", *one.estimate.value,
                         options.max_overlap_gap_mm);
  return "ok";
}

void add_rail(const Section& section, const MeasuredObject& object, const MeasureOptions& options,
              MeasuredFrame& row) {
  RailMeasurement rail = measure_rail(section, object.reference, row.registration, options.rail);
  visit_estimates([&](const char* name, const Estimate& e) { row.estimates.push_back({name, e}); }, rail);
  row.extras.push_back({"crown_radius", rail.crown_radius});
  row.extras.push_back({"lip", rail.lip});
  row.extras.push_back(
      {"overlap_gap", row.registration.view == RegistrationView::kNone
                          ? Estimate::unknown(row.registration.reason)
                          : overlap_gap(place(section, object.reference, row.registration))});
}

}  // namespace

MeasuredFrame measure_profile(const Profile& profile, const MeasuredObject& object,
                              const MeasureOptions& options) {
  MeasuredFrame row;
  row.frame = profile.frame;
  row.travel = profile.travel;
  row.nominal = object.reference.name();
  const Section section = section_of(profile);
  row.registration = register_section(section, object.reference, object.prior, options.registration);
  if (object.reference.kind() == ObjectKind::kRail) {
    add_rail(section, object, options, row);
  } else {
    WheelMeasurement wheel =
        measure_wheel(section, object.reference, row.registration, object.wheel, options.wheel);
    visit_estimates([&](const char* name, const Estimate& e) { row.estimates.push_back({name, e}); }, wheel);
    row.extras.push_back({"radial_deviation", wheel.radius});
    row.extras.push_back({"axial_deviation", wheel.back_place});
  }
  row.status = status_of(row, options);
  return row;
}

bool any_known(const MeasuredFrame& row, const MeasureOptions& options) {
  const auto known = [&](const NamedEstimate& one) {
    return one.estimate.value && (options.required.empty() || is_required(one.name, options));
  };
  return std::any_of(row.estimates.begin(), row.estimates.end(), known) ||
         (!options.required.empty() && std::any_of(row.extras.begin(), row.extras.end(), known));
}

std::vector<std::string> estimate_names(ObjectKind kind) {
  std::vector<std::string> names;
  const auto keep = [&](const char* name, const Estimate&) { names.emplace_back(name); };
  RailMeasurement rail;
  WheelMeasurement wheel;
  if (kind == ObjectKind::kRail) visit_estimates(keep, rail);
  if (kind == ObjectKind::kWheel) visit_estimates(keep, wheel);
  return names;
}

std::vector<std::string> extra_names(ObjectKind kind) {
  if (kind == ObjectKind::kRail) return {"crown_radius", "lip", "overlap_gap"};
  return {"radial_deviation", "axial_deviation"};
}

}  // namespace lightstripe
