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

/// One sensor's points in a strip of the top: their heights over the reference, so that the outline's slope
/// takes no part.
struct Strip {
  std::vector<double> heights, places;
};

std::map<int, Strip> strips_of(const PlacedSection& placed, int sensor) {
  std::map<int, Strip> strips;
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    const Vector2d& p = placed.points[i];
    if (placed.section[i].sensor != sensor || placed.section[i].weight < kTrusted ||
        std::abs(p.x()) > kHalfWidthMm)
      continue;
    const auto surface = placed.reference.surface_along({p.x(), 0}, {0, 1}, 0);
    if (!surface || std::abs(p.y() - *surface) >= kDepthMm) continue;
    Strip& strip = strips[static_cast<int>(std::floor(p.x() / kStripMm))];
    strip.heights.push_back(p.y() - *surface), strip.places.push_back(p.x());
  }
  std::erase_if(strips, [](const auto& one) { return one.second.heights.size() < 2; });
  return strips;
}

/// 1-sigma of the sum of one sensor's strips, each times its factor.
double sigma_of_strips(const ErrorAlong& error, const std::vector<const Strip*>& strips,
                       const std::vector<double>& factors) {
  constexpr double kMedianLoss = 1.2;  // variance of the median of a few points over that of their mean
  std::vector<double> places, each;
  for (std::size_t k = 0; k < strips.size(); ++k)
    for (const double place : strips[k]->places) {
      const auto n = static_cast<double>(strips[k]->places.size());
      places.push_back(place), each.push_back(factors[k] / n);
    }
  ErrorAlong of_medians = error;
  of_medians.own_mm *= std::sqrt(kMedianLoss);
  return sigma_of_sum(of_medians, places, each);
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
  const auto first = strips_of(placed, sensors[0]), second = strips_of(placed, sensors[1]);
  std::vector<Sample1> differences;
  std::vector<const Strip*> of_first, of_second;
  for (const auto& [place, strip] : first)
    if (const auto other = second.find(place); other != second.end()) {
      differences.push_back({place * kStripMm, median(strip.heights) - median(other->second.heights)});
      of_first.push_back(&strip), of_second.push_back(&other->second);
    }
  if (differences.size() < kFewestStrips)
    return Estimate::unknown("the sensors share less than 5 mm of the head");
  const auto fit = fit_polynomial(differences, 0, 0.003);
  if (!fit) return Estimate::unknown("the sensors' heights scatter");
  const std::vector<double> factors = influences(differences, *fit, 0, 0);
  const ErrorAlong& error = placed.registration.error;
  return Estimate::known(fit->value, std::hypot(sigma_of_strips(error, of_first, factors),
                                                sigma_of_strips(error, of_second, factors)));
}

}  // namespace lightstripe
