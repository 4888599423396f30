// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/run_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace lightstripe {
namespace {

Estimate* extra_of(MeasuredFrame& row, std::string_view name) {
  for (NamedEstimate& one : row.extras)
    if (one.name == name) return &one.estimate;
  return nullptr;
}

/// Largest part of the turn without a measured frame, deg.
double widest_gap_deg(std::vector<double> angles) {
  constexpr double kTurn = 360;
  for (double& angle : angles) angle -= kTurn * std::floor(angle / kTurn);
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + kTurn - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest;
}

Estimate run_out_of(std::vector<MeasuredFrame>& rows, std::string_view name) {
  constexpr double kWidestGapDeg = 45;
  std::vector<Estimate*> known;
  std::vector<double> angles;
  std::string reason = "no frames";
  for (MeasuredFrame& row : rows) {
    Estimate* const place = extra_of(row, name);
    if (place && place->value) {
      known.push_back(place);
      angles.push_back(row.travel);
    } else if (place) {
      reason = place->reason;
    }
  }
  if (known.empty()) return Estimate::unknown(reason);
  double mean = 0, variance = 0;
  for (const Estimate* place : known) {
    mean += *place->value / static_cast<double>(known.size());
    variance += std::pow(place->sigma.value_or(0), 2) / static_cast<double>(known.size());
  }
  for (Estimate* place : known) *place->value -= mean;
  const double gap = widest_gap_deg(std::move(angles));
  if (gap > kWidestGapDeg)
    return Estimate::unknown(fmt::format("{:.0f} deg of the turn were not measured", gap));
  const auto lower = [](const Estimate* a, const Estimate* b) { return *a->value < *b->value; };
  const auto [low, high] = std::minmax_element(known.begin(), known.end(), lower);
  return Estimate::known(*(*high)->value - *(*low)->value, std::sqrt(2 * variance));
}

}  // namespace

RunOut find_run_out(std::vector<MeasuredFrame>& rows) {
  return {run_out_of(rows, "radial_deviation"), run_out_of(rows, "axial_deviation")};
}

}  // namespace lightstripe
