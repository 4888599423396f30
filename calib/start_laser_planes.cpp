// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "calib/initial_values.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMinPoints = 3;    // of a stripe on one board
constexpr std::size_t kMaxPairs = 2000;  // of views tried as the plane's start
// A stripe this near to the plane agrees with it, as a share of the range.
constexpr double kRoughAgreement = 0.01, kAgreement = 0.0015;

/// The stripe of one view, in space: rays cut with the board's plane.
struct StripeInSpace {
  std::size_t view = 0;
  std::vector<Vector3d> points;  ///< camera frame, mm
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double distance_to(const Plane& plane, const StripeInSpace& stripe) {
  std::vector<double> distances;
  for (const auto& p : stripe.points) distances.push_back(std::abs(plane.signed_distance(p)));
  return median(std::move(distances));
}

std::vector<StripeInSpace> stripes_in_space(const InitialValues& values, int sensor, std::size_t plane) {
  std::vector<StripeInSpace> result;
  const auto& camera = values.state.sensors[static_cast<std::size_t>(sensor)].camera;
  for (std::size_t i = 0; i < values.measurements.views.size(); ++i) {
    const auto& view = values.measurements.views[i];
    if (view.sensor != sensor || view.pose < 0) continue;
    const Plane board = board_plane(values.cam_from_board[i]);
    StripeInSpace stripe{i, {}};
    for (const auto& point : view.stripes[plane]) {
      const auto ray = unproject(camera, {point.x, point.y});
      const auto p = ray ? intersect(board, Vector3d::Zero(), *ray) : std::nullopt;
      if (p) stripe.points.push_back(*p);
    }
    if (stripe.points.size() >= kMinPoints) result.push_back(std::move(stripe));
  }
  return result;
}

PlaneFit plane_through(const std::vector<const StripeInSpace*>& stripes) {
  std::vector<Vector3d> points;
  for (const auto* stripe : stripes)
    points.insert(points.end(), stripe->points.begin(), stripe->points.end());
  return fit_plane(points);
}

/// Least median over the views of the plane through two of them: up to half of the views may show something
/// else.
std::optional<Plane> least_median_plane(const std::vector<StripeInSpace>& stripes) {
  const std::size_t n = stripes.size();
  const std::size_t step = std::max<std::size_t>(1, n * (n - 1) / 2 / kMaxPairs);
  double best = std::numeric_limits<double>::infinity();
  std::optional<Plane> plane;
  std::size_t pair = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j, ++pair) {
      if (pair % step != 0) continue;
      const PlaneFit fit = plane_through({&stripes[i], &stripes[j]});
      if (!fit.determined()) continue;
      std::vector<double> distances;
      distances.reserve(n);
      for (const auto& stripe : stripes) distances.push_back(distance_to(fit.plane, stripe));
      const double score = median(std::move(distances));
      if (score >= best) continue;
      best = score;
      plane = fit.plane;
    }
  }
  return plane;
}

std::vector<const StripeInSpace*> near_plane(const std::vector<StripeInSpace>& stripes, const Plane& plane,
                                             double share_of_range, double least_mm) {
  std::vector<const StripeInSpace*> result;
  for (const auto& stripe : stripes)
    if (distance_to(plane, stripe) <= std::max(share_of_range * stripe.points.front().norm(), least_mm))
      result.push_back(&stripe);
  return result;
}

/// The stripes that lie in one plane. Two views alone place the plane badly elsewhere: all views near it, by
/// a generous measure, place it better, and a strict measure then follows.
std::vector<const StripeInSpace*> agreeing(const std::vector<StripeInSpace>& stripes) {
  std::vector<const StripeInSpace*> roughly;
  const auto start = least_median_plane(stripes);
  if (start) roughly = near_plane(stripes, *start, kRoughAgreement, 0);
  if (!start)
    for (const auto& stripe : stripes)
      roughly.push_back(&stripe);  // no pair spans a plane: the caller says so
  if (!start || roughly.size() < 2) return roughly;
  const Plane plane = plane_through(roughly).plane;
  std::vector<double> distances;
  distances.reserve(roughly.size());
  for (const auto* stripe : roughly) distances.push_back(distance_to(plane, *stripe));
  return near_plane(stripes, plane, kAgreement, 5 * median(std::move(distances)));
}

std::string plane_name(const InitialValues& values, int sensor, std::size_t plane) {
  const auto& s = values.measurements.sensor_names[static_cast<std::size_t>(sensor)];
  return plane == 0 ? fmt::format("sensor {}", s) : fmt::format("sensor {}, laser plane {}", s, plane + 1);
}

void refuse_degenerate(const PlaneFit& fit, const std::vector<const StripeInSpace*>& stripes,
                       const std::string& name) {
  constexpr double kMinSpread = 0.03;  // of the longer extent
  constexpr double kMinOffset = 0.01;  // of the range: below it the stripe does not move with the range
  if (fit.spread.y() < kMinSpread * fit.spread.x() || fit.spread.y() < 3 * fit.rms || !fit.determined())
    throw NotUsable(
        fmt::format("{}: all stripes lie on one line in space, which fixes no laser plane; hold the board at "
                    "different distances and tilt it across the stripe",
                    name));
  double range = 0;
  for (const auto* stripe : stripes)
    range += stripe->points.front().norm() / static_cast<double>(stripes.size());
  if (fit.plane.offset < kMinOffset * range)
    throw NotUsable(
        fmt::format("{}: the camera lies in the laser plane ({:.1f} mm beside it), the stripe does not move "
                    "with the range; set the laser farther from the camera",
                    name, fit.plane.offset));
}

Plane start_plane(InitialValues& values, int sensor, std::size_t plane) {
  const auto name = plane_name(values, sensor, plane);
  const auto stripes = stripes_in_space(values, sensor, plane);
  if (stripes.size() < 2)
    throw NotUsable(
        fmt::format("{}: the stripe was found on {} boards only; at least 2 are needed, better all of them",
                    name, stripes.size()));
  const auto kept = agreeing(stripes);
  if (kept.size() < 2)
    throw NotUsable(
        fmt::format("{}: the stripes of the boards lie in no common plane; check that each laser image shows "
                    "the pose of its board image",
                    name));
  const PlaneFit fit = plane_through(kept);
  refuse_degenerate(fit, kept, name);
  for (auto& view : values.measurements.views)
    if (view.sensor == sensor && view.pose >= 0 && view.stripes[plane].size() < kMinPoints)
      view.stripes[plane].clear();
  for (const auto& stripe : stripes) {
    auto& view = values.measurements.views[stripe.view];
    const bool agrees = std::find(kept.begin(), kept.end(), &stripe) != kept.end();
    const bool crosses = stripe_line(board_plane(values.cam_from_board[stripe.view]), fit.plane).has_value();
    if (agrees && crosses) continue;
    view.stripes[plane].clear();
    values.warnings.push_back(
        agrees ? fmt::format("{}: stripe left out, the board is parallel to the laser plane", view.image)
               : fmt::format("{}: stripe left out, it lies {:.1f} mm off the laser plane of the others",
                             view.image, distance_to(fit.plane, stripe)));
  }
  return fit.plane;
}

}  // namespace

void start_laser_planes(InitialValues& values) {
  for (std::size_t sensor = 0; sensor < values.state.sensors.size(); ++sensor) {
    std::size_t planes = 0;
    for (const auto& view : values.measurements.views)
      if (view.sensor == static_cast<int>(sensor)) planes = std::max(planes, view.stripes.size());
    for (std::size_t plane = 0; plane < planes; ++plane)
      values.state.sensors[sensor].laser_planes.push_back(
          start_plane(values, static_cast<int>(sensor), plane));
  }
}

}  // namespace lightstripe
