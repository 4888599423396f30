// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "calib/start/stripe_planes.h"

namespace lightstripe {
namespace {

using Stripes = std::vector<std::vector<StripePoint>>;

constexpr std::size_t kMaxPermuted = 6;  // planes up to which every order is tried

bool of_sensor(const SessionView& view, int sensor) { return view.sensor == sensor && view.pose >= 0; }

/// Direction of a stripe in the image, radians in 0 .. pi.
double direction(const std::vector<StripePoint>& stripe) {
  if (stripe.size() < 2) return 0;
  const double angle = std::atan2(stripe.back().y - stripe.front().y, stripe.back().x - stripe.front().x);
  return angle < 0 ? angle + std::acos(-1.0) : angle;
}

void sort_by_direction(InitialValues& values, int sensor) {
  for (auto& view : values.session.views)
    if (of_sensor(view, sensor))
      std::stable_sort(view.stripes.begin(), view.stripes.end(),
                       [](const auto& a, const auto& b) { return direction(a) < direction(b); });
}

/// Median distance of the points of view i's stripe `from` to a plane, capped; 0 for a stripe too short to
/// tell.
double misfit(const InitialValues& values, std::size_t i, const std::vector<StripePoint>& stripe,
              const std::optional<Plane>& plane) {
  constexpr double kCap_mm = 20;
  if (stripe.size() < kMinStripePoints || !plane) return 0;
  const auto& view = values.session.views[i];
  const auto& camera = values.state.sensors[static_cast<std::size_t>(view.sensor)].camera;
  const Plane board = board_plane(values.cam_from_board[i]);
  StripeInSpace in_space{i, 0, {}};
  for (const auto& point : stripe) {
    const auto ray = unproject(camera, {point.x, point.y});
    const auto p = ray ? intersect(board, Eigen::Vector3d::Zero(), *ray) : std::nullopt;
    if (p) in_space.points.push_back(*p);
  }
  return in_space.points.empty() ? 0 : std::min(kCap_mm, distance_to(*plane, in_space));
}

/// The order of the view's stripes that fits the planes best: result[k] = which stripe lies in plane k.
std::vector<std::size_t> best_order(const InitialValues& values, std::size_t i,
                                    const std::vector<std::optional<Plane>>& planes) {
  const auto& stripes = values.session.views[i].stripes;
  std::vector<std::size_t> order(planes.size()), best;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<std::vector<double>> cost(planes.size(), std::vector<double>(stripes.size()));
  for (std::size_t k = 0; k < planes.size(); ++k)
    for (std::size_t s = 0; s < stripes.size(); ++s) cost[k][s] = misfit(values, i, stripes[s], planes[k]);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0;
    for (std::size_t k = 0; k < planes.size(); ++k) sum += cost[k][order[k]];
    if (sum < least - 1e-12) least = sum, best = order;
  } while (planes.size() <= kMaxPermuted && std::next_permutation(order.begin(), order.end()));
  return best;
}

/// Planes by majority, stripes to the nearest plane, until nothing changes; returns the misfit per stripe
/// that is left.
double settle(InitialValues& values, int sensor, std::size_t planes) {
  constexpr int kMaxRounds = 10;
  double cost = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<std::optional<Plane>> fitted;
    for (std::size_t k = 0; k < planes; ++k)
      fitted.push_back(least_median_plane(stripes_in_space(values, sensor, k)));
    bool changed = false;
    cost = 0;
    for (std::size_t i = 0; i < values.session.views.size(); ++i) {
      auto& view = values.session.views[i];
      if (!of_sensor(view, sensor)) continue;
      const auto order = best_order(values, i, fitted);
      Stripes sorted;
      for (std::size_t k = 0; k < planes; ++k) {
        changed = changed || order[k] != k;
        cost += misfit(values, i, view.stripes[order[k]], fitted[k]);
        sorted.push_back(view.stripes[order[k]]);
      }
      view.stripes = std::move(sorted);
    }
    if (!changed) break;
  }
  return cost;
}

}  // namespace

void label_stripes(InitialValues& values, int sensor, std::size_t planes) {
  InitialValues by_place = values, by_direction = values;
  sort_by_direction(by_direction, sensor);
  const double place_cost = settle(by_place, sensor, planes),
               direction_cost = settle(by_direction, sensor, planes);
  // Lines beside each other differ by place, crossing ones by direction.
  values.session.views =
      std::move(direction_cost < place_cost ? by_direction.session.views : by_place.session.views);
}

}  // namespace lightstripe
