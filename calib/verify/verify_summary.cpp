// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "calib/verify/verify_rig.h"

namespace lightstripe {
namespace {

/// Root mean square of what was added.
struct Rms {
  double squares = 0;
  int count = 0;

  void add(double value) {
    squares += value * value;
    ++count;
  }
  double value() const { return count > 0 ? std::sqrt(squares / count) : 0; }
};

std::vector<std::string> sensors_of(const Verification& verification) {
  std::vector<std::string> names;
  for (const auto& view : verification.views)
    if (names.empty() || names.back() != view.sensor) names.push_back(view.sensor);
  return names;
}

}  // namespace

std::vector<VerifiedSensor> by_sensor(const Verification& verification) {
  std::vector<VerifiedSensor> sensors;
  for (const auto& name : sensors_of(verification)) {
    Rms corner, plane, length;
    for (const auto& view : verification.views) {
      if (view.sensor != name) continue;
      corner.add(view.corner_rms_px);
      if (view.stripe_points == 0) continue;
      plane.add(view.plane_rms_mm);
      if (view.length_mm > 0) length.add(view.length_error_mm);
    }
    sensors.push_back({name, plane.count, corner.value(), plane.value(), length.value()});
  }
  return sensors;
}

std::vector<VerifiedSeam> by_seam(const Verification& verification) {
  std::vector<VerifiedSeam> seams;
  for (const auto& name : sensors_of(verification)) {
    for (const auto& other : sensors_of(verification)) {
      Rms gap, centre;
      for (const auto& pair : verification.pairs) {
        if (pair.sensor != name || pair.other != other) continue;
        centre.add(pair.centre_gap_mm);
        if (pair.gap_mm) gap.add(*pair.gap_mm);
      }
      if (centre.count > 0) seams.push_back({name, other, centre.count, gap.value(), centre.value()});
    }
  }
  return seams;
}

std::vector<std::string> exceeded(const Verification& verification, const VerifyLimits& limits) {
  std::vector<std::string> reasons;
  const auto check = [&](double value, double limit, const std::string& what) {
    if (limit > 0 && value > limit)
      reasons.push_back(fmt::format("{}: {:.3f} mm, the limit is {:.3f} mm", what, value, limit));
  };
  for (const auto& sensor : by_sensor(verification)) {
    check(sensor.plane_rms_mm, limits.max_plane_rms_mm, sensor.name + ": stripe off the board's plane");
    check(sensor.length_error_mm, limits.max_length_error_mm, sensor.name + ": distances along the board");
  }
  for (const auto& seam : by_seam(verification))
    check(seam.gap_mm, limits.max_gap_mm, "gap between " + seam.sensor + " and " + seam.other);
  if (verification.travel_rms_mm)
    check(*verification.travel_rms_mm, limits.max_travel_mm, "fixed board over the travel");
  return reasons;
}

}  // namespace lightstripe
