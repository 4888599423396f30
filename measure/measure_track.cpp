// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_track.h"

#include <algorithm>

#include "measure/track_gauge.h"

namespace lightstripe {
namespace {

/// Gauge and, if asked for, conicity.
struct TrackResult {
  Estimate gauge;
  Conicity conicity;
};

TrackResult look_at_both(const RailPair& rails, const MeasuredTrack& track, const MeasuredFrame& left,
                         const MeasuredFrame& right, const RailOptions& options) {
  const auto unknown = [](const std::string& reason) {
    TrackResult out{Estimate::unknown(reason), {}};
    out.conicity.reason = reason;
    return out;
  };
  if (!left.registration.usable()) return unknown("left rail: " + left.registration.reason);
  if (!right.registration.usable()) return unknown("right rail: " + right.registration.reason);
  const Section left_section = section_of(rails.left), right_section = section_of(rails.right);
  const PlacedSection at_left = place(left_section, track.left, left.registration),
                      at_right = place(right_section, track.right, right.registration);
  const TrackPlane plane = find_track_plane(at_left, at_right, options, track.rig_sigma_mm);
  TrackResult out{plane.gauge, {}};
  if (track.wheelset) out.conicity = conicity_of_track(at_left, at_right, plane, *track.wheelset, options);
  return out;
}

void add_conicity(const Conicity& conicity, MeasuredFrame& row) {
  const auto estimate = [&](const std::optional<double>& value, const std::optional<double>& sigma) {
    if (conicity.usable() && value) return Estimate{value, sigma, ""};
    return Estimate::unknown(conicity.usable() ? "no wave of this amplitude: " + conicity.note
                                               : conicity.reason);
  };
  row.extras.push_back({"conicity", estimate(conicity.at_3_mm, conicity.at_3_mm_sigma)});
  row.extras.push_back({"conicity_nonlinearity", estimate(conicity.nonlinearity_per_mm, std::nullopt)});
  row.conicity = conicity.rows;
}

}  // namespace

MeasuredFrame measure_track(const Profile& profile, const MeasuredTrack& track,
                            const MeasureOptions& options) {
  const RailPair rails = split_rails(profile, track.between_u);
  MeasureOptions left_options = options, right_options = options;
  left_options.rail.gauge_side = GaugeSide::kRight;
  right_options.rail.gauge_side = GaugeSide::kLeft;
  MeasuredFrame row = measure_profile(rails.left, {track.left, {}, {}}, left_options);
  const MeasuredFrame right = measure_profile(rails.right, {track.right, {}, {}}, right_options);
  const auto [gauge, conicity] = look_at_both(rails, track, row, right, options.rail);
  row.extras.push_back({"gauge", gauge});
  for (const auto* list : {&right.estimates, &right.extras})
    for (const NamedEstimate& one : *list) row.extras.push_back({"right_" + one.name, one.estimate});
  row.right_registration = right.registration;
  if (track.wheelset) add_conicity(conicity, row);
  if (row.status != "ok")
    row.status = "left rail: " + row.status;
  else if (right.status != "ok")
    row.status = "right rail: " + right.status;
  else if (!gauge.value && (options.required.empty() ||
                            std::count(options.required.begin(), options.required.end(), "gauge") > 0))
    row.status = "gauge: " + gauge.reason;
  return row;
}

std::vector<std::string> track_extra_names(bool with_conicity) {
  std::vector<std::string> names = extra_names(ObjectKind::kRail);
  names.emplace_back("gauge");
  for (const auto& list : {estimate_names(ObjectKind::kRail), extra_names(ObjectKind::kRail)})
    for (const std::string& name : list) names.push_back("right_" + name);
  if (with_conicity) names.insert(names.end(), {"conicity", "conicity_nonlinearity"});
  return names;
}

}  // namespace lightstripe
