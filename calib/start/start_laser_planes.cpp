// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "calib/start/initial_values.h"
#include "calib/start/stripe_planes.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

// A stripe this near to the plane agrees with it, as a share of the range.
constexpr double kRoughAgreement = 0.01, kAgreement = 0.0015;

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
    if (view.sensor == sensor && view.pose >= 0 && view.stripes[plane].size() < kMinStripePoints)
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
    if (planes > 1) label_stripes(values, static_cast<int>(sensor), planes);
    for (std::size_t plane = 0; plane < planes; ++plane)
      values.state.sensors[sensor].laser_planes.push_back(
          start_plane(values, static_cast<int>(sensor), plane));
  }
}

}  // namespace lightstripe
