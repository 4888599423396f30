// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/correlation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace lightstripe {

namespace {

/// The points that count, and what they say of their neighbours.
struct Neighbours {
  std::vector<const FitPoint*> counting;
  std::vector<int> chain;
  double variance = 0;

  Neighbours(const Section& section, const std::vector<FitPoint>& points) {
    double squares = 0;
    for (const FitPoint& point : points) {
      if (point.weight <= 0) continue;
      counting.push_back(&point), squares += point.residual * point.residual;
      chain.push_back(section[static_cast<std::size_t>(point.index)].chain);
    }
    if (!counting.empty()) variance = squares / static_cast<double>(counting.size());
  }
  bool enough() const { return counting.size() >= 10 && variance > 0; }

  /// Mean of `of(a, b)` over the pairs `lag` points apart on one chain; nothing where there are few.
  template <class Of>
  std::optional<double> mean_of_pairs(std::size_t lag, const Of& of) const {
    double sum = 0, pairs = 0;
    for (std::size_t i = lag; i < counting.size(); ++i)
      if (chain[i] == chain[i - lag]) sum += of(*counting[i], *counting[i - lag]), pairs += 1;
    if (pairs < 10) return std::nullopt;
    return sum / pairs;
  }
  std::optional<double> correlation(std::size_t lag) const {
    const auto product =
        mean_of_pairs(lag, [](const FitPoint& a, const FitPoint& b) { return a.residual * b.residual; });
    return product ? std::optional(*product / variance) : std::nullopt;
  }
};

}  // namespace

double correlated_points(const Section& section, const std::vector<FitPoint>& points) {
  constexpr std::size_t kMostLags = 60;
  const Neighbours neighbours(section, points);
  if (!neighbours.enough()) return 1;
  double sum = 1;
  for (std::size_t lag = 1; lag <= std::min(kMostLags, neighbours.counting.size() / 4); ++lag) {
    const auto correlation = neighbours.correlation(lag);
    if (!correlation || *correlation <= 0) break;
    sum += 2 * *correlation;
  }
  return sum;
}

double correlation_length_mm(const Section& section, const std::vector<FitPoint>& points) {
  constexpr std::size_t kMostLags = 30;
  constexpr double kFallen = 1 / std::numbers::e;
  const Neighbours neighbours(section, points);
  if (!neighbours.enough()) return 0;
  const auto spacing = neighbours.mean_of_pairs(
      1, [](const FitPoint& a, const FitPoint& b) { return (a.position - b.position).norm(); });
  double before = 1;
  for (std::size_t lag = 1; spacing && lag <= kMostLags; ++lag) {
    const double here = neighbours.correlation(lag).value_or(0);
    if (lag == 1 && here <= kFallen) return here > 0 ? -*spacing / std::log(here) : 0;
    if (here <= kFallen)
      return *spacing * (static_cast<double>(lag - 1) + (before - kFallen) / (before - here));
    before = here;
  }
  return spacing.value_or(0) * kMostLags;
}

double stretch_error_mm(const Section& section, const std::vector<FitPoint>& points) {
  constexpr double kStretchMm = 8;
  constexpr int kFewestPoints = 5, kFewestStretches = 4;
  double squares = 0, sum = 0;
  int stretches = 0, count = 0;
  const FitPoint* first = nullptr;
  const auto close = [&] {
    if (count >= kFewestPoints) squares += sum * sum / count / count, ++stretches;
    sum = 0, count = 0, first = nullptr;
  };
  for (const FitPoint& point : points) {
    if (point.weight <= 0) continue;
    const auto chain_of = [&](const FitPoint& p) { return section[static_cast<std::size_t>(p.index)].chain; };
    if (first &&
        (chain_of(*first) != chain_of(point) || (point.position - first->position).norm() > kStretchMm))
      close();
    if (!first) first = &point;
    sum += point.residual, ++count;
  }
  close();
  return stretches >= kFewestStretches ? std::sqrt(squares / stretches) : 0.0;
}

}  // namespace lightstripe
