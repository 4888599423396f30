// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/light_end.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightstripe {
namespace {

double density(double z) { return 0.3989422804 * std::exp(-0.5 * z * z); }

/// Logarithms of the lit share at z = kFirst + i kStep.
struct LogShares {
  static constexpr double kFirst = -1, kStep = 0.125;
  static constexpr auto kTries = static_cast<std::size_t>((kFarthestInside - kFirst) / kStep) + 1;
  static constexpr auto kStepsPerSample = static_cast<std::size_t>(1 / (kEndSamplesPerSigma * kStep));
  std::array<double, kTries + kStepsPerSample*(kEndSamples - 1)> values{};

  LogShares() {
    for (std::size_t i = 0; i < values.size(); ++i)
      values.at(i) = std::log(LightEnd::share(kFirst + kStep * static_cast<double>(i)));
  }
};

}  // namespace

double LightEnd::share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double LightEnd::scatter(double z) { return std::sqrt(share(std::numbers::sqrt2 * z)) / share(z); }

double LightEnd::shift(double z) const {
  const double s2 = width * width, across2 = s2 + sigma * sigma;
  double total = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const double lit = z + s2 / across2 * total / spread;  // the shift leads to where there is more light
    const double slope = density(lit) / share(lit);        // of the strength's logarithm, in 1 / spread
    const double aside = s2 * slope / spread, turn = s2 * slope * (lit + slope) / (spread * spread);
    const double sharpness = std::max(0.3, 1 - lit * slope * across2 / (sigma * sigma));
    const double next = aside + across2 * turn * slope / (sigma * sharpness);
    total = pass == 0 ? next : 0.5 * (total + next);
  }
  return total;
}

EndOfStrength fit_light_end(std::span<const double, kEndSamples> strengths) {
  static const LogShares log_shares;
  std::array<double, kEndSamples> logs{};
  for (std::size_t k = 0; k < kEndSamples; ++k) logs.at(k) = std::log(std::max(strengths[k], 1e-9));
  EndOfStrength best{kFarthestInside, std::numeric_limits<double>::infinity()};
  for (std::size_t t = LogShares::kTries; t-- > 0;) {
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < kEndSamples; ++k) {
      const double difference = logs.at(k) - log_shares.values.at(t + k * LogShares::kStepsPerSample);
      sum += difference;
      squares += difference * difference;
    }
    const double misfit = squares - sum * sum / kEndSamples;
    if (misfit < best.misfit) best = {LogShares::kFirst + LogShares::kStep * static_cast<double>(t), misfit};
  }
  return best;
}

}  // namespace lightstripe
