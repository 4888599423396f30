// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/profile_orientation.h"

#include <algorithm>
#include <cmath>

#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

/// Median height of the points between two places; 0 if there are none.
double height_between(const std::vector<Vector2d>& points, double from, double to) {
  std::vector<double> heights;
  for (const Vector2d& p : points)
    if (p.x() >= from && p.x() <= to) heights.push_back(p.y());
  return heights.empty() ? 0.0 : median(std::move(heights));
}

void turn_rail(std::vector<Vector2d>& points) {
  double low = points[0].x(), high = points[0].x();
  for (const Vector2d& p : points) low = std::min(low, p.x()), high = std::max(high, p.x());
  const double quarter = (high - low) / 4, middle = (low + high) / 2;
  const double top = height_between(points, middle - quarter, middle + quarter);
  const double sides =
      (height_between(points, low, low + quarter / 4) + height_between(points, high - quarter / 4, high)) / 2;
  if (top < sides)
    for (Vector2d& p : points) p.y() = -p.y();
}

/// Whether x counts from the tread datum: then it lies within the points, and the flange's back at its end.
bool counts_from_datum(const std::vector<Vector2d>& points) {
  constexpr double kWithinMm = 30;
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  return low->x() < -kWithinMm && high->x() > kWithinMm;
}

/// Makes x count from the flange's back, positive. Of a file that counts from the datum the flange is the end
/// that differs more from the tread: its tip is over 20 mm away, the rim's edge a few.
void count_from_back(std::vector<Vector2d>& points) {
  constexpr double kTipFrom = kTreadDatumMm - 22, kTipTo = kTreadDatumMm - 10;  // distances from the datum
  if (counts_from_datum(points)) {
    const double tread = height_between(points, -3, 3);
    const double left = std::abs(height_between(points, -kTipTo, -kTipFrom) - tread),
                 right = std::abs(height_between(points, kTipFrom, kTipTo) - tread);
    for (Vector2d& p : points) p.x() = kTreadDatumMm + (left >= right ? p.x() : -p.x());
    return;
  }
  double sum = 0;
  for (const Vector2d& p : points) sum += p.x();
  if (sum < 0)
    for (Vector2d& p : points) p.x() = -p.x();
}

void turn_wheel(std::vector<Vector2d>& points) {
  count_from_back(points);
  const double flange = height_between(points, 8, 24),
               tread = height_between(points, kTreadDatumMm - 3, kTreadDatumMm + 3);
  if (flange < tread)
    for (Vector2d& p : points) p.y() = -p.y();
  for (Vector2d& p : points) p.x() -= kTreadDatumMm;
}

}  // namespace

void turn_upright(RecordedProfile& profile) {
  if (profile.kind == ObjectKind::kRail) {
    turn_rail(profile.points);
  } else {
    turn_wheel(profile.points);
  }
}

}  // namespace lightstripe
