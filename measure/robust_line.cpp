// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/robust_line.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Weighted {
  VectorXd c;
  MatrixXd H_inverse;
};

VectorXd powers(double t, int degree) {
  VectorXd row(degree + 1);
  for (int k = 0; k <= degree; ++k) row(k) = k == 0 ? 1 : row(k - 1) * t;
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
  const Eigen::FullPivLU<MatrixXd> lu(H);
  if (!(lu.rcond() > kDetermined)) return std::nullopt;
  return Weighted{lu.solve(g), lu.inverse()};
}

/// Weights of the next round; returns the scale.
double reweight(const std::vector<Sample1>& samples, const VectorXd& c, double min_scale,
                std::vector<double>& weights) {
  const int degree = static_cast<int>(c.size()) - 1;
  std::vector<double> residuals;
  for (const Sample1& s : samples) residuals.push_back(std::abs(s.value - c.dot(powers(s.t, degree))));
  const double scale = std::max(min_scale, 1.4826 * median_of(residuals));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = residuals[i] / (4.685 * scale);  // 95 % efficient for normal noise
    weights[i] = t < 1 ? (1 - t * t) * (1 - t * t) : 0.0;
  }
  return scale;
}

}  // namespace

double median_of(std::vector<double> values) {
  LIGHTSTRIPE_CHECK(!values.empty(), "the median of nothing");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<PolynomialFit> fit_polynomial(const std::vector<Sample1>& samples, int degree,
                                            double min_scale) {
  constexpr int kRounds = 8;
  constexpr double kCounts = 0.1;  // weight
  if (static_cast<int>(samples.size()) < degree + 3) return std::nullopt;
  std::vector<double> weights(samples.size(), 1.0);
  VectorXd start = VectorXd::Zero(degree + 1);  // the level first, so that a third of outliers cannot bend it
  std::vector<double> values;
  for (const Sample1& s : samples) values.push_back(s.value);
  start(0) = median_of(values);
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
  out.value_factor = fit->H_inverse(0, 0);
  out.slope_factor = degree > 0 ? fit->H_inverse(1, 1) : 0.0;
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double r = samples[i].value - fit->c.dot(powers(samples[i].t, degree));
    squares += weights[i] * r * r, sum += weights[i];
    out.num_samples += weights[i] > kCounts ? 1 : 0;
  }
  out.rms = std::sqrt(squares / std::max(sum, 1e-12));
  if (out.num_samples < degree + 3) return std::nullopt;
  return out;
}

}  // namespace lightstripe
