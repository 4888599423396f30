// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/correlation.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {

double correlated_points(const Section& section, const std::vector<FitPoint>& points) {
  constexpr std::size_t kMostLags = 60;
  const auto chain_of = [&](const FitPoint& p) { return section[static_cast<std::size_t>(p.index)].chain; };
  std::vector<const FitPoint*> counting;
  double squares = 0;
  for (const FitPoint& point : points)
    if (point.weight > 0) counting.push_back(&point), squares += point.residual * point.residual;
  if (counting.size() < 10 || !(squares > 0)) return 1;
  const double variance = squares / static_cast<double>(counting.size());
  double sum = 1;
  for (std::size_t lag = 1; lag <= std::min(kMostLags, counting.size() / 4); ++lag) {
    double product = 0, pairs = 0;
    for (std::size_t i = lag; i < counting.size(); ++i) {
      if (chain_of(*counting[i]) != chain_of(*counting[i - lag])) continue;
      product += counting[i]->residual * counting[i - lag]->residual, pairs += 1;
    }
    if (pairs < 10 || product <= 0) break;
    sum += 2 * product / pairs / variance;
  }
  return sum;
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
