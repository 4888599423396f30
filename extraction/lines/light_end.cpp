// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/light_end.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lightstripe {
namespace {

/// Of the standard normal distribution.
double density(double z) { return std::numbers::inv_sqrtpi / std::numbers::sqrt2 * std::exp(-0.5 * z * z); }

constexpr double kFirst = -1, kStep = 0.125;  // of z in the tables
constexpr auto kTries = static_cast<std::size_t>((kFarthestInside - kFirst) / kStep) + 1;
constexpr auto kStepsPerSample = static_cast<std::size_t>(1 / (kEndSamplesPerSpread * kStep));
constexpr std::size_t kEntries = kTries + kStepsPerSample * (kEndSamples - 1);
/// Of a stripe over the kernels' sigma.
constexpr double kNarrowest = 0.2, kWidthGrowth = 1.25;
constexpr std::size_t kWidths = 10;

}  // namespace

/// For stripes of one width and cuts of one tangent, at z = kFirst + i kStep.
struct EndTable {
  std::array<double, kEntries> log_strengths{};
  std::array<double, kEntries> shifts{};  ///< over the square of the stripe's width, sigma = 1
  std::array<double, kEntries> scatters{};

  EndTable(double width, double tangent) {
    const LightEnd light{1, width, tangent};
    for (std::size_t i = 0; i < kEntries; ++i) {
      const double z = kFirst + kStep * static_cast<double>(i);
      log_strengths.at(i) = std::log(light.strength(z));
      shifts.at(i) = light.shift(z) / (width * width);
      scatters.at(i) = LightEnd::scatter(z);
    }
  }
};

namespace {

/// Computed once.
const EndTable& table_of(const LightEnd& light) {
  static const auto tables = [] {
    std::vector<EndTable> all;
    for (const double tangent : kEndTangents)
      for (std::size_t i = 0; i < kWidths; ++i)
        all.emplace_back(kNarrowest * std::pow(kWidthGrowth, static_cast<double>(i)), tangent);
    return all;
  }();
  const auto nearer = [&](double a, double b) {
    return std::abs(a - light.tangent) < std::abs(b - light.tangent);
  };
  const auto tangent =
      std::min_element(kEndTangents.begin(), kEndTangents.end(), nearer) - kEndTangents.begin();
  const double place = std::log(light.width / (light.sigma * kNarrowest)) / std::log(kWidthGrowth);
  const auto width = static_cast<std::size_t>(std::lround(std::clamp(place, 0.0, kWidths - 1.0)));
  return tables[static_cast<std::size_t>(tangent) * kWidths + width];
}

}  // namespace

double LightEnd::share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double LightEnd::scatter(double z) { return std::sqrt(share(std::numbers::sqrt2 * z)) / share(z); }

double LightEnd::spread() const {
  const double square = width * width;
  return sigma * std::sqrt(1 + tangent * tangent * square / (square + sigma * sigma));
}

double LightEnd::shift(double z) const {
  const double s2 = width * width, across2 = s2 + sigma * sigma, length = spread();
  double total = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const double lit =
        z + tangent * s2 / across2 * total / length;  // the shift leads to where there is more light
    const double slope = density(lit) / share(lit);   // of the strength's logarithm, times the length
    const double aside = s2 * slope / length, turn = s2 * slope * (lit + slope) / (length * length);
    const double sharpness = std::max(0.3, 1 - lit * slope * across2 / (length * length));
    const double next = tangent * (aside + across2 * turn * slope / (length * sharpness));
    total = pass == 0 ? next : 0.5 * (total + next);
  }
  return total / tangent;
}

double LightEnd::strength(double z) const {
  const double s2 = width * width, across2 = s2 + sigma * sigma;
  const double turn = tangent * s2 / (across2 * spread());  // of z by a px across
  const double x = tangent * shift(z), lit = z + turn * x, slope = density(lit) / share(lit);
  return std::exp(-0.5 * x * x / across2) * share(lit) * (1 + across2 * turn * turn * slope * (lit + slope));
}

EndCurves::EndCurves(const LightEnd& light)
    : table_(&table_of(light)), gain_(light.width * light.width / light.sigma) {}

EndInfluence EndCurves::at(double z) const {
  const double place = std::max(0.0, (z - kFirst) / kStep);
  const auto entry = static_cast<std::size_t>(place);
  if (entry + 1 >= kEntries) return {};
  const double share = place - static_cast<double>(entry);
  const auto between = [&](const std::array<double, kEntries>& values) {
    return values[entry] + share * (values[entry + 1] - values[entry]);
  };
  return {gain_ * between(table_->shifts), between(table_->scatters)};
}

EndOfStrength fit_light_end(const LightEnd& light, std::span<const double, kEndSamples> strengths) {
  const EndTable& expected = table_of(light);
  std::array<double, kEndSamples> logs{};
  for (std::size_t k = 0; k < kEndSamples; ++k) logs.at(k) = std::log(std::max(strengths[k], 1e-9));
  EndOfStrength best{kFarthestInside, std::numeric_limits<double>::infinity()};
  for (std::size_t t = kTries; t-- > 0;) {
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < kEndSamples; ++k) {
      const double difference = logs.at(k) - expected.log_strengths.at(t + k * kStepsPerSample);
      sum += difference;
      squares += difference * difference;
    }
    const double misfit = squares - sum * sum / kEndSamples;
    if (misfit < best.misfit) best = {kFirst + kStep * static_cast<double>(t), misfit};
  }
  return best;
}

}  // namespace lightstripe
