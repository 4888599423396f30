// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/overlap_gap.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/robust.h"
#include "measure/robust_line.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kStripMm = 1.0, kHalfWidthMm = 30, kDepthMm = 12, kTrusted = 0.02;

/// Per strip of the top: the median height over the reference, so that the outline's slope takes no part.
std::map<int, double> heights_of(const PlacedSection& placed, int sensor) {
  constexpr std::size_t kFewest = 2;
  std::map<int, std::vector<double>> strips;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d& p = placed.points[i];
    if (placed.section[i].sensor != sensor || placed.section[i].weight < kTrusted ||
        std::abs(p.x()) > kHalfWidthMm)
      continue;
    const auto surface = placed.reference.surface_along({p.x(), 0}, {0, 1}, 0);
    if (surface && std::abs(p.y() - *surface) < kDepthMm)
      strips[static_cast<int>(std::floor(p.x() / kStripMm))].push_back(p.y() - *surface);
  }
  std::map<int, double> out;
  for (auto& [strip, heights] : strips)
    if (heights.size() >= kFewest) out.emplace(strip, median(std::move(heights)));
  return out;
}

}  // namespace

Estimate overlap_gap(const PlacedSection& placed) {
  constexpr std::size_t kFewestStrips = 5;
  std::vector<int> sensors;
  for (const SectionPoint& point : placed.section)
    if (std::find(sensors.begin(), sensors.end(), point.sensor) == sensors.end())
      sensors.push_back(point.sensor);
  if (sensors.size() < 2) return Estimate::unknown("one sensor only");
  std::sort(sensors.begin(), sensors.end());
  const auto first = heights_of(placed, sensors[0]), second = heights_of(placed, sensors[1]);
  std::vector<Sample1> differences;
  for (const auto& [strip, height] : first)
    if (const auto other = second.find(strip); other != second.end())
      differences.push_back({strip * kStripMm, height - other->second});
  if (differences.size() < kFewestStrips)
    return Estimate::unknown("the sensors share less than 5 mm of the head");
  const auto fit = fit_polynomial(differences, 0, 0.003);
  if (!fit) return Estimate::unknown("the sensors' heights scatter");
  return Estimate::known(fit->value, std::max(fit->rms, 0.003) * std::sqrt(fit->value_factor));
}

}  // namespace lightstripe
