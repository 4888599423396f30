// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/smoothing_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

/// Weights of the third derivative from four values (6 times the third divided difference).
std::array<double, 4> third_derivative(const std::vector<double>& t, std::size_t i) {
  std::array<double, 4> weights{};
  for (std::size_t a = 0; a < 4; ++a) {
    double product = 1;
    for (std::size_t b = 0; b < 4; ++b)
      if (b != a) product *= t[i + a] - t[i + b];
    weights[a] = 6 / product;
  }
  return weights;
}

}  // namespace

SmoothingSpline::SmoothingSpline(const std::vector<double>& places, const std::vector<double>& strengths)
    : diagonal_(places.size(), 1.0),
      one_(places.size(), 0.0),
      two_(places.size(), 0.0),
      three_(places.size(), 0.0) {
  const std::size_t n = places.size();
  LIGHTSTRIPE_CHECK(n >= 4 && strengths.size() == n, "a smoothing spline needs four places or more");
  for (std::size_t i = 0; i + 3 < n; ++i) {
    const std::array<double, 4> d = third_derivative(places, i);
    const double weight = strengths[i + 1] * (places[i + 3] - places[i]) / 3;
    for (std::size_t a = 0; a < 4; ++a) {
      diagonal_[i + a] += weight * d[a] * d[a];
      if (a >= 1) one_[i + a] += weight * d[a] * d[a - 1];
      if (a >= 2) two_[i + a] += weight * d[a] * d[a - 2];
      if (a >= 3) three_[i + a] += weight * d[a] * d[a - 3];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double l3 = i >= 3 ? three_[i] / diagonal_[i - 3] : 0;
    const double c2 = i >= 2 ? two_[i] - (i >= 3 ? l3 * diagonal_[i - 3] * one_[i - 2] : 0) : 0;
    const double l2 = i >= 2 ? c2 / diagonal_[i - 2] : 0;
    double c1 = i >= 1 ? one_[i] : 0;
    if (i >= 2) c1 -= l2 * diagonal_[i - 2] * one_[i - 1];
    if (i >= 3) c1 -= l3 * diagonal_[i - 3] * two_[i - 1];
    const double l1 = i >= 1 ? c1 / diagonal_[i - 1] : 0;
    if (i >= 1) diagonal_[i] -= l1 * l1 * diagonal_[i - 1];
    if (i >= 2) diagonal_[i] -= l2 * l2 * diagonal_[i - 2];
    if (i >= 3) diagonal_[i] -= l3 * l3 * diagonal_[i - 3];
    one_[i] = l1, two_[i] = l2, three_[i] = l3;
  }
}

std::vector<double> SmoothingSpline::operator()(const std::vector<double>& values) const {
  const std::size_t n = diagonal_.size();
  LIGHTSTRIPE_CHECK(values.size() == n, "one value a place");
  std::vector<double> x = values;
  for (std::size_t i = 1; i < n; ++i) {
    x[i] -= one_[i] * x[i - 1];
    if (i >= 2) x[i] -= two_[i] * x[i - 2];
    if (i >= 3) x[i] -= three_[i] * x[i - 3];
  }
  for (std::size_t i = 0; i < n; ++i) x[i] /= diagonal_[i];
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) x[i] -= one_[i + 1] * x[i + 1];
    if (i + 2 < n) x[i] -= two_[i + 2] * x[i + 2];
    if (i + 3 < n) x[i] -= three_[i + 3] * x[i + 3];
  }
  return x;
}

double spent_parameters(const std::vector<double>& places, const std::vector<double>& strengths) {
  const std::size_t n = places.size();
  double trace = 3;  // parabolas pass
  for (std::size_t i = 0; i < n; ++i) {
    const double spacing =
        (places[std::min(i + 1, n - 1)] - places[i > 0 ? i - 1 : 0]) / (i > 0 && i + 1 < n ? 2 : 1);
    // integral of 1 / (1 + strength spacing omega^6) over the frequencies that the places carry
    trace += std::min(1.0, spacing / 3 * std::pow(strengths[i] * spacing, -1.0 / 6));
  }
  return std::min(trace, static_cast<double>(n) - 1);
}

double spent_on_shared_errors(const std::vector<double>& places, const std::vector<double>& strengths,
                              double correlation_mm) {
  using std::numbers::pi;
  const std::size_t n = places.size();
  const double spacing = (places.back() - places.front()) / static_cast<double>(n - 1);
  const double kept = std::exp(-spacing / correlation_mm), shared = (1 + kept) / (1 - kept);
  double trace = 3 * shared;  // parabolas pass
  for (std::size_t i = 0; i < n; ++i) {
    // The noise's spectrum 1 / (1 + reach^2 omega^2) through the spline's 1 / (1 + (width omega)^6): both
    // limits of their integral are exact.
    const double reach = spacing * shared / 2, width = std::pow(strengths[i] * spacing, 1.0 / 6);
    trace += 2 / pi * std::atan(pi / 3 * reach / width);
  }
  return std::min(trace, static_cast<double>(n) - 1);
}

double third_derivative_of(const std::vector<double>& places, const std::vector<double>& values,
                           std::size_t i) {
  const std::array<double, 4> weights = third_derivative(places, i);
  double sum = 0;
  for (std::size_t a = 0; a < 4; ++a) sum += weights[a] * values[i + a];
  return sum;
}

double difference_noise(const std::vector<double>& values) {
  constexpr double kVariance = 20;  // 1 + 9 + 9 + 1
  std::vector<double> differences;
  for (std::size_t i = 0; i + 3 < values.size(); ++i)
    differences.push_back(std::abs(values[i + 3] - 3 * values[i + 2] + 3 * values[i + 1] - values[i]));
  if (differences.empty()) return 0;
  return kMadToSigma * median(std::move(differences)) / std::sqrt(kVariance);
}

}  // namespace lightstripe
