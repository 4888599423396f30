// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/stripe_planes.h"

#include <algorithm>
#include <limits>

#include "core/robust.h"

namespace lightstripe {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kMaxPairs = 2000;  // of views tried as the plane's start
// A stripe this near to the plane agrees with it, as a share of the range.
constexpr double kRoughAgreement = 0.01, kAgreement = 0.0015;

std::vector<const StripeInSpace*> near_plane(const std::vector<StripeInSpace>& stripes, const Plane& plane,
                                             double share_of_range, double least_mm) {
  std::vector<const StripeInSpace*> result;
  for (const auto& stripe : stripes) {
    const double range = stripe.points.front().norm();
    const double tolerance = std::clamp(least_mm, share_of_range * range, kRoughAgreement * range);
    if (distance_to(plane, stripe) <= tolerance) result.push_back(&stripe);
  }
  return result;
}

}  // namespace

double distance_to(const Plane& plane, const StripeInSpace& stripe) {
  std::vector<double> distances;
  for (const auto& p : stripe.points) distances.push_back(std::abs(plane.signed_distance(p)));
  return upper_median(distances);
}

StripeInSpace stripe_in_space(const InitialValues& values, std::size_t of, std::size_t board,
                              std::size_t plane) {
  const auto& view = values.session.views[of];
  const auto& camera = values.state.sensors[static_cast<std::size_t>(view.sensor)].camera;
  const Plane surface = board_plane(values.cam_from_board[board]);
  StripeInSpace stripe{of, plane, {}};
  for (const auto& point : view.stripes[plane]) {
    const auto ray = unproject(camera, {point.x, point.y});
    const auto p = ray ? intersect(surface, Vector3d::Zero(), *ray) : std::nullopt;
    if (p) stripe.points.push_back(*p);
  }
  return stripe;
}

std::vector<StripeInSpace> stripes_in_space(const InitialValues& values, int sensor, std::size_t plane) {
  std::vector<StripeInSpace> result;
  for (std::size_t i = 0; i < values.session.views.size(); ++i) {
    const auto& view = values.session.views[i];
    if (view.sensor != sensor || view.pose < 0) continue;
    auto stripe = stripe_in_space(values, i, i, plane);
    if (stripe.points.size() >= kMinStripePoints) result.push_back(std::move(stripe));
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
      const double score = upper_median(distances);
      if (score >= best) continue;
      best = score;
      plane = fit.plane;
    }
  }
  return plane;
}

std::vector<const StripeInSpace*> stripes_in_one_plane(const std::vector<StripeInSpace>& stripes) {
  std::vector<const StripeInSpace*> roughly;
  const auto start = least_median_plane(stripes);
  if (start) roughly = near_plane(stripes, *start, kRoughAgreement, 0);
  if (!start)
    for (const auto& stripe : stripes)
      roughly.push_back(&stripe);  // no pair spans a plane: the caller says so
  if (!start || roughly.size() < 2) return roughly;
  // Two views alone place the plane badly elsewhere: all views near it place it better, and a strict measure
  // then follows.
  const Plane plane = plane_through(roughly).plane;
  std::vector<double> distances;
  distances.reserve(roughly.size());
  for (const auto* stripe : roughly) distances.push_back(distance_to(plane, *stripe));
  return near_plane(stripes, plane, kAgreement, 5 * upper_median(distances));
}

}  // namespace lightstripe
