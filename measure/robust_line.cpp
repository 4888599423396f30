// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/robust_line.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/linear_algebra.h"
#include "core/robust.h"

namespace lightstripe {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kCounts = 0.1;  // share of the largest weight

struct Weighted {
  VectorXd c;
  MatrixXd H_inverse;
};

VectorXd powers(double t, int degree) {
  VectorXd row(degree + 1);
  for (int k = 0; k <= degree; ++k) row(k) = k == 0 ? 1 : row(k - 1) * t;
  return row;
}

VectorXd derived_powers(double t, int degree, int derivative) {
  VectorXd row = powers(t, degree);
  for (int round = 0; round < derivative; ++round) {
    for (int k = degree; k > 0; --k) row(k) = k * row(k - 1);
    row(0) = 0;
  }
  return row;
}

std::optional<Weighted> solve(const std::vector<Sample1>& samples, const std::vector<double>& weights,
                              int degree) {
  constexpr double kDetermined = 1e-9;
  MatrixXd H = MatrixXd::Zero(degree + 1, degree + 1);
  VectorXd g = VectorXd::Zero(degree + 1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const VectorXd row = powers(samples[i].t, degree);
    H += weights[i] * row * row.transpose();
    g += weights[i] * samples[i].value * row;
  }
  const auto inverse = inverse_of(H, kDetermined);
  if (!inverse) return std::nullopt;
  return Weighted{*inverse * g, *inverse};
}

/// Robust scale of residuals of a fit of so many parameters: the median would let few points agree by chance
/// (order statistic and small-sample factor of Rousseeuw and Leroy's least median of squares).
double robust_scale(std::vector<double> residuals, int parameters) {
  const auto n = static_cast<double>(residuals.size()), p = static_cast<double>(parameters);
  const auto order = std::min(residuals.size() - 1, static_cast<std::size_t>((n + p + 1) / 2));
  return kMadToSigma * (1 + 5 / std::max(1.0, n - p)) * value_at_rank(residuals, order);
}

/// Weights of the next round.
void reweight(const std::vector<Sample1>& samples, const VectorXd& c, double min_scale,
              std::vector<double>& weights) {
  const int degree = static_cast<int>(c.size()) - 1;
  std::vector<double> residuals;
  for (const Sample1& s : samples) residuals.push_back(std::abs(s.value - c.dot(powers(s.t, degree))));
  double heaviest = 0;
  for (const Sample1& s : samples) heaviest = std::max(heaviest, s.weight);
  std::vector<double> trusted;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples[i].weight > kCounts * heaviest) trusted.push_back(residuals[i]);
  const double scale = std::max(min_scale, robust_scale(std::move(trusted), degree + 1));
  for (std::size_t i = 0; i < samples.size(); ++i)
    weights[i] = samples[i].weight / heaviest * tukey_weight(residuals[i] / scale);
}

}  // namespace

std::optional<PolynomialFit> fit_polynomial(const std::vector<Sample1>& samples, int degree,
                                            double min_scale) {
  constexpr int kRounds = 8;
  if (static_cast<int>(samples.size()) < degree + 3) return std::nullopt;
  std::vector<double> weights(samples.size(), 1.0);
  VectorXd start = VectorXd::Zero(degree + 1);  // the level first, so that a third of outliers cannot bend it
  std::vector<double> values;
  double heaviest = 0;
  for (const Sample1& s : samples) heaviest = std::max(heaviest, s.weight);
  for (const Sample1& s : samples)
    if (s.weight > kCounts * heaviest) values.push_back(s.value);
  if (values.empty()) return std::nullopt;
  start(0) = median(values);
  reweight(samples, start, min_scale, weights);
  std::optional<Weighted> fit;
  for (int round = 0; round < kRounds; ++round) {
    fit = solve(samples, weights, degree);
    if (!fit) return std::nullopt;
    if (round + 1 < kRounds) reweight(samples, fit->c, min_scale, weights);
  }
  PolynomialFit out;
  out.value = fit->c(0);
  out.slope = degree > 0 ? fit->c(1) : 0.0;
  out.curvature = degree > 1 ? 2 * fit->c(2) : 0.0;
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double r = samples[i].value - fit->c.dot(powers(samples[i].t, degree));
    squares += weights[i] * r * r, sum += weights[i];
    out.num_samples += weights[i] > kCounts ? 1 : 0;
  }
  out.rms = std::sqrt(squares / std::max(sum, 1e-12));
  if (out.num_samples < degree + 3) return std::nullopt;
  const double small_sample = out.num_samples / static_cast<double>(out.num_samples - degree - 1);
  out.value_factor = kTukeyVariance * small_sample * fit->H_inverse(0, 0);
  out.slope_factor = degree > 0 ? kTukeyVariance * small_sample * fit->H_inverse(1, 1) : 0.0;
  out.weights = std::move(weights);
  return out;
}

std::vector<double> influences(const std::vector<Sample1>& samples, const PolynomialFit& fit, int degree,
                               double t, int derivative) {
  LIGHTSTRIPE_CHECK(fit.weights.size() == samples.size(), "the fit is one of these samples");
  const auto solved = solve(samples, fit.weights, degree);
  std::vector<double> out(samples.size(), 0.0);
  if (!solved) return out;
  const VectorXd at = solved->H_inverse * derived_powers(t, degree, derivative);
  for (std::size_t i = 0; i < samples.size(); ++i)
    out[i] = fit.weights[i] * at.dot(powers(samples[i].t, degree));
  return out;
}

}  // namespace lightstripe
