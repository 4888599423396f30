// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/track_conicity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kBelowMm = 2;  // of the face below the gauge point: the spline's end must not lie on it

/// A point of the head in polar coordinates about its inside, about which every worn head is star-shaped.
struct PolarPoint {
  double angle, radius;
  Vector2d place;  ///< y, z
  double weight;
  int sensor;
};

std::vector<PolarPoint> head_points(const PlacedSection& rail, const TrackPlane& track, TrackSide side,
                                    double depth_mm) {
  constexpr double kTrusted = 0.02, kWidestMm = 100, kBehindMm = 5, kInsideMm = 30, kLeastSigmaMm = 1e-3;
  const auto s = static_cast<std::size_t>(side);
  const Vector2d outwards = side == TrackSide::kLeft ? track.across : Vector2d(-track.across),
                 up(-track.across.y(), track.across.x());
  const Vector2d inside((track.crest[s] - track.gauge_point[s]).dot(outwards), -kInsideMm);
  std::vector<PolarPoint> points;
  for (const SectionPoint& point : rail.section) {
    const Vector2d place((point.position - track.gauge_point[s]).dot(outwards),
                         (point.position - track.crest[s]).dot(up));
    if (point.weight <= kTrusted || place.y() < -depth_mm - kBelowMm || place.x() < -kBehindMm ||
        place.x() > kWidestMm)
      continue;
    const Vector2d arm = place - inside;
    const double sigma = std::max(point.sigma_mm, kLeastSigmaMm);
    points.push_back(
        {-std::atan2(arm.y(), arm.x()), arm.norm(), place, point.weight / (sigma * sigma), point.sensor});
  }
  std::sort(points.begin(), points.end(),
            [](const PolarPoint& a, const PolarPoint& b) { return a.angle < b.angle; });
  return points;
}

/// Signed distance of the middle one of `window` from a line along them, and how far they scatter about it.
struct LocalLine {
  double off = 0, scatter = 0;
};
LocalLine line_through(std::span<const PolarPoint> window, const PolarPoint& middle) {
  const std::size_t third = window.size() / 3;
  const auto median_of = [](std::span<const PolarPoint> part, auto member) {
    std::vector<double> values;
    for (const PolarPoint& point : part) values.push_back(point.*member);
    return upper_median(values);
  };
  const auto first = window.first(third), last = window.last(third);
  const double angle = median_of(last, &PolarPoint::angle) - median_of(first, &PolarPoint::angle);
  const double rise = median_of(last, &PolarPoint::radius) - median_of(first, &PolarPoint::radius);
  const double slope = angle > 0 ? rise / angle : 0;
  std::vector<double> residuals;
  for (const PolarPoint& point : window) residuals.push_back(point.radius - slope * point.angle);
  const double level = upper_median(residuals);
  for (double& residual : residuals) residual = std::abs(residual - level);
  return {middle.radius - slope * middle.angle - level, upper_median(residuals)};
}

/// Leaves out what lies farther off its neighbours than they scatter.
void drop_strays(std::vector<PolarPoint>& points) {
  constexpr std::size_t kWindow = 15;
  constexpr double kSpreads = 6, kLeastMm = 0.1;
  if (points.size() < kWindow) return;
  std::vector<PolarPoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t from = std::min(i > kWindow / 2 ? i - kWindow / 2 : 0, points.size() - kWindow);
    const LocalLine line = line_through(std::span(points).subspan(from, kWindow), points[i]);
    if (std::abs(line.off) <= std::max(kLeastMm, kSpreads * line.scatter)) kept.push_back(points[i]);
  }
  points = std::move(kept);
}

/// Variance of the mean of `count` points of one sensor on a run over that of a single one, the points'
/// correlation being exp(-distance / correlation_mm).
double variance_of_mean(int count, double correlation_mm) {
  double sum = 1;
  for (int k = 1; k < count && correlation_mm > 0; ++k)
    sum += 2 * (1 - static_cast<double>(k) / count) * std::exp(-k * kRailPointMm / count / correlation_mm);
  return sum / count;
}

/// Means of runs not longer than kRailPointMm: what one sensor sees at a glance counts little where another
/// looks straight at it.
RailHead means_of_runs(const std::vector<PolarPoint>& points, double correlation_mm) {
  RailHead head;
  Vector2d sum = Vector2d::Zero();
  double weight = 0, first = 0, shares = 0;
  struct Part {
    double weight = 0;
    int count = 0;
  };
  std::map<int, Part> of_sensor;
  const auto close = [&] {
    if (weight <= 0) return;
    head.points.push_back(sum / weight);
    for (const auto& [sensor, part] : of_sensor)
      shares += std::pow(part.weight / weight, 2) * variance_of_mean(part.count, correlation_mm);
    sum = Vector2d::Zero(), weight = 0, of_sensor.clear();
  };
  for (const PolarPoint& point : points) {
    if (weight > 0 && (point.angle - first) * point.radius > kRailPointMm) close();
    if (weight == 0) first = point.angle;
    sum += point.weight * point.place, weight += point.weight;
    Part& part = of_sensor[point.sensor];
    part.weight += point.weight, ++part.count;
  }
  close();
  if (!head.points.empty()) head.variance_share = shares / static_cast<double>(head.points.size());
  return head;
}

/// The registration has seen how the points scatter about parts that do not wear, and over what length
/// they share their errors: neighbours on a stripe are no independent measurements.
RollingProfile rolling_rail(const RailHead& head, const Registration& registration, const char* name) {
  constexpr double kLongestMm = 4;
  SmoothingOptions smoothing;
  if (registration.rms_mm > 0) smoothing.sigma_mm = registration.rms_mm * std::sqrt(head.variance_share);
  smoothing.correlation_mm = std::min(kLongestMm, registration.correlation_mm);
  return {name, RunningSurface::measured(head.points, smoothing), 0, 0};
}

Conicity unknown(const std::string& reason) {
  Conicity out;
  out.reason = reason;
  return out;
}

}  // namespace

RailHead rail_head_of(const PlacedSection& rail, const TrackPlane& track, TrackSide side, double depth_mm) {
  constexpr std::size_t kFewest = 30;
  constexpr double kWidestHoleMm = 5, kRolledMm = 50;
  std::vector<PolarPoint> points = head_points(rail, track, side, depth_mm);
  drop_strays(points);
  RailHead head = means_of_runs(points, rail.registration.correlation_mm);
  if (head.points.size() < kFewest) head.reason = "has too few points where wheels roll";
  for (std::size_t i = 1; i < head.points.size(); ++i)
    if (head.points[i - 1].x() < kRolledMm && (head.points[i] - head.points[i - 1]).norm() > kWidestHoleMm)
      head.reason = "has a hole where wheels roll";
  if (!head.points.empty() && head.points.back().x() < kRolledMm) head.reason = "is not seen across the head";
  return head;
}

Conicity conicity_of_track(const PlacedSection& left, const PlacedSection& right, const TrackPlane& track,
                           const ReferenceWheelset& wheelset, const RailOptions& options) {
  if (!track.gauge.value) return unknown("gauge: " + track.gauge.reason);
  const RailHead heads[kSides] = {rail_head_of(left, track, TrackSide::kLeft, options.gauge_point_mm),
                                  rail_head_of(right, track, TrackSide::kRight, options.gauge_point_mm)};
  if (!heads[0].reason.empty()) return unknown("left rail " + heads[0].reason);
  if (!heads[1].reason.empty()) return unknown("right rail " + heads[1].reason);
  ConicityOptions with_gauge = wheelset.options;
  with_gauge.gauge_mm = *track.gauge.value;
  with_gauge.gauge_sigma_mm = track.gauge.sigma.value_or(0);
  return equivalent_conicity(wheelset.wheels,
                             {rolling_rail(heads[0], left.registration, "left rail"),
                              rolling_rail(heads[1], right.registration, "right rail")},
                             with_gauge);
}

}  // namespace lightstripe
