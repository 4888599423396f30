// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/measure_track.h"

#include <algorithm>

#include "measure/track_gauge.h"

namespace lightstripe {
namespace {

Estimate gauge_of(const RailPair& rails, const MeasuredTrack& track, const MeasuredFrame& left,
                  const MeasuredFrame& right, const RailOptions& options) {
  if (!left.registration.usable()) return Estimate::unknown("left rail: " + left.registration.reason);
  if (!right.registration.usable()) return Estimate::unknown("right rail: " + right.registration.reason);
  const Section left_section = section_of(rails.left), right_section = section_of(rails.right);
  return track_gauge(place(left_section, track.left, left.registration),
                     place(right_section, track.right, right.registration), options, track.rig_sigma_mm);
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
  const Estimate gauge = gauge_of(rails, track, row, right, options.rail);
  row.extras.push_back({"gauge", gauge});
  for (const auto* list : {&right.estimates, &right.extras})
    for (const NamedEstimate& one : *list) row.extras.push_back({"right_" + one.name, one.estimate});
  row.right_registration = right.registration;
  if (row.status != "ok")
    row.status = "left rail: " + row.status;
  else if (right.status != "ok")
    row.status = "right rail: " + right.status;
  else if (!gauge.value && (options.required.empty() ||
                            std::count(options.required.begin(), options.required.end(), "gauge") > 0))
    row.status = "gauge: " + gauge.reason;
  return row;
}

std::vector<std::string> track_extra_names() {
  std::vector<std::string> names = extra_names(ObjectKind::kRail);
  names.emplace_back("gauge");
  for (const auto& list : {estimate_names(ObjectKind::kRail), extra_names(ObjectKind::kRail)})
    for (const std::string& name : list) names.push_back("right_" + name);
  return names;
}

}  // namespace lightstripe
