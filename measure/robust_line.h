// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A polynomial through scattered values, robust against those that do not belong.
#pragma once

#include <optional>
#include <vector>

namespace lightstripe {

/// Below this robust scale a fit to recorded points does not go: instruments write hundredths of a mm.
inline constexpr double kMinScaleMm = 0.005;

struct Sample1 {
  double t = 0, value = 0;
  double weight = 1;  ///< beforehand, 0 .. 1
};

/// Of normal noise with Tukey's weights at 4.685 sigma: the variance of a weighted mean, over (sum w r^2 /
/// sum w) / sum w. E[w] = 0.915, E[w r^2] = 0.757 sigma^2, variance 1.053 sigma^2 / n.
inline constexpr double kTukeyVariance = 1.165;

struct PolynomialFit {
  double value = 0, slope = 0, curvature = 0;  ///< at t = 0; curvature = second derivative
  double value_factor = 0;                     ///< variance of value / rms^2, independent samples
  double slope_factor = 0;                     ///< the same of the slope
  double rms = 0;                              ///< of the samples, weighted
  int num_samples = 0;                         ///< that count
  std::vector<double> weights;                 ///< of the samples in the end
};

/// Least squares, with the samples' weights relative to their largest, times Tukey's biweight (scale from the
/// median residual, at least `min_scale`), degree 0, 1 or
/// 2. Nothing if fewer than degree + 3 samples count or they do not determine the polynomial.
std::optional<PolynomialFit> fit_polynomial(const std::vector<Sample1>& samples, int degree,
                                            double min_scale);

/// How much each sample moves the polynomial's value at `t`, or its first or second derivative there:
/// d value / d sample, the weights held.
std::vector<double> influences(const std::vector<Sample1>& samples, const PolynomialFit& fit, int degree,
                               double t, int derivative = 0);

}  // namespace lightstripe
