// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/error_along.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

/// Mean product of residuals, by their points' distance.
struct Covariances {
  double distance_mm = 0, product = 0, pairs = 0;
};

std::vector<Covariances> covariances_along(const Section& section, const std::vector<FitPoint>& points) {
  constexpr double kReachMm = 16, kBinMm = 0.5;
  std::vector<Covariances> bins(static_cast<std::size_t>(kReachMm / kBinMm) + 1);
  const auto chain_of = [&](const FitPoint& p) { return section[static_cast<std::size_t>(p.index)].chain; };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].weight <= 0) continue;
    for (std::size_t k = i + 1; k < points.size() && chain_of(points[k]) == chain_of(points[i]); ++k) {
      const double distance = (points[k].position - points[i].position).norm();
      if (distance > kReachMm) break;
      if (points[k].weight <= 0) continue;
      Covariances& bin = bins[static_cast<std::size_t>(distance / kBinMm)];
      bin.distance_mm += distance, bin.product += points[i].residual * points[k].residual, bin.pairs += 1;
    }
  }
  std::erase_if(bins, [](const Covariances& bin) { return bin.pairs < 10; });
  for (Covariances& bin : bins) bin.distance_mm /= bin.pairs, bin.product /= bin.pairs;
  return bins;
}

/// What the point's residual changes by with turn and shift.
Eigen::Vector3d gradient_of(const FitPoint& point) {
  const Eigen::Vector2d &p = point.position, &n = point.normal;
  return {p.x() * n.y() - p.y() * n.x(), n.x(), n.y()};
}

/// Of the shared part's variance, what goes into the pose instead of the residuals: tr(H^-1 G) of the normal
/// equations H and the covariance G of their right side, over the sum of weights.
double share_in_pose(const ErrorAlong& error, const Section& section, const std::vector<FitPoint>& points) {
  constexpr double kMostLost = 2.0 / 3;  // beyond it the little that is left tells nothing
  if (error.shared_mm <= 0) return 0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  double weights = 0;
  for (const FitPoint& point : points) {
    if (point.weight <= 0) continue;
    const Eigen::Vector3d g = gradient_of(point);
    normal += point.weight * g * g.transpose(), weights += point.weight;
  }
  const Eigen::Matrix3d unit = gradient_covariance({0, 1, error.length_mm}, section, points);
  const double share = solve_symmetric(normal, unit).trace() / weights;
  return std::isfinite(share) ? std::clamp(share, 0.0, kMostLost) : kMostLost;
}

}  // namespace

ErrorAlong error_along(const Section& section, const std::vector<FitPoint>& points) {
  double variance = 0, count = 0;
  for (const FitPoint& point : points)
    if (point.weight > 0) variance += point.residual * point.residual, count += 1;
  if (count < 10) return {};
  variance /= count;
  const std::vector<Covariances> bins = covariances_along(section, points);
  ErrorAlong best{std::sqrt(variance), 0, 1};
  // A product of independent errors scatters by their variance: what they seem to share by chance lowers the
  // cost by a few times its square.
  constexpr double kByChance = 9;
  double best_cost = -kByChance * variance * variance;
  for (const Covariances& bin : bins) best_cost += bin.pairs * bin.product * bin.product;
  for (const double length : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    double upper = 0, lower = 1e-30, cost = 0;
    for (const Covariances& bin : bins) {
      const double shape = std::exp(-bin.distance_mm / length);
      upper += bin.pairs * shape * bin.product, lower += bin.pairs * shape * shape;
    }
    const double shared = std::clamp(upper / lower, 0.0, variance);
    for (const Covariances& bin : bins)
      cost += bin.pairs * std::pow(bin.product - shared * std::exp(-bin.distance_mm / length), 2);
    if (cost < best_cost) best_cost = cost, best = {std::sqrt(variance - shared), std::sqrt(shared), length};
  }
  // The pose took the long waves: neighbours differ as before, by shared^2 / length.
  const double grown = 1 / (1 - share_in_pose(best, section, points));
  best.shared_mm *= std::sqrt(grown), best.length_mm *= grown;
  return best;
}

double sigma_of_sum(const ErrorAlong& error, const std::vector<double>& places,
                    const std::vector<double>& factors) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
  double own = 0, shared = 0, before = 0;  // what the points before share with this one
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double factor = factors[order[i]];
    if (i > 0) before *= std::exp(-(places[order[i]] - places[order[i - 1]]) / error.length_mm);
    own += factor * factor;
    shared += factor * (factor + 2 * before);
    before += factor;
  }
  return std::sqrt(error.own_mm * error.own_mm * own +
                   error.shared_mm * error.shared_mm * std::max(0.0, shared));
}

double sigma_of_sum(const ErrorAlong& error, const std::vector<PlaceOnStripe>& places,
                    const std::vector<double>& factors) {
  struct Stripe {
    std::vector<double> places, factors;
  };
  std::map<int, Stripe> stripes;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Stripe& stripe = stripes[places[i].chain];
    stripe.places.push_back(places[i].along_mm), stripe.factors.push_back(factors[i]);
  }
  double variance = 0;
  for (const auto& [chain, stripe] : stripes)
    variance += std::pow(sigma_of_sum(error, stripe.places, stripe.factors), 2);
  return std::sqrt(variance);
}

ErrorAlong where_points_scatter(const ErrorAlong& error, double here_mm, int count) {
  const double usual = std::hypot(error.own_mm, error.shared_mm);
  const double by_chance = 1 + 3 / std::sqrt(2.0 * count);
  ErrorAlong local = error;
  if (here_mm > by_chance * usual)
    local.own_mm = std::sqrt(error.own_mm * error.own_mm + here_mm * here_mm - usual * usual);
  return local;
}

Eigen::Matrix3d gradient_covariance(const ErrorAlong& error, const Section& section,
                                    const std::vector<FitPoint>& points) {
  const double own = error.own_mm * error.own_mm, shared = error.shared_mm * error.shared_mm;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  const FitPoint* last = nullptr;
  const auto chain_of = [&](const FitPoint& p) { return section[static_cast<std::size_t>(p.index)].chain; };
  for (const FitPoint& point : points) {
    if (point.weight <= 0) continue;
    if (last != nullptr)
      before *= chain_of(*last) == chain_of(point)
                    ? std::exp(-(point.position - last->position).norm() / error.length_mm)
                    : 0.0;
    const Eigen::Vector3d g = point.weight * gradient_of(point);
    sum += (own + shared) * g * g.transpose() + shared * (g * before.transpose() + before * g.transpose());
    before += g;
    last = &point;
  }
  return sum;
}

}  // namespace lightstripe
