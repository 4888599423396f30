// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A discrete smoothing spline over uneven places: least squares with a penalty on the third derivative.
#pragma once

#include <vector>

namespace lightstripe {

/// Minimises sum (x_i - v_i)^2 + integral strength(t) (x''')^2 dt (Whittaker 1923, third differences). The
/// factorisation serves any number of value lists. `places` ascend strictly; at least four. `strengths`: one
/// a place.
class SmoothingSpline {
 public:
  SmoothingSpline(const std::vector<double>& places, const std::vector<double>& strengths);

  std::vector<double> operator()(const std::vector<double>& values) const;

 private:
  // L D L' of the seven-diagonal matrix: row i of L has entries at i - 1, i - 2, i - 3.
  std::vector<double> diagonal_, one_, two_, three_;
};

/// How many parameters the spline spends: the trace of its smoothing matrix, as that of a spline of the local
/// strength on even endless places.
double spent_parameters(const std::vector<double>& places, const std::vector<double>& strengths);

/// The same where neighbours share their errors, correlation exp(-distance / correlation_mm): the trace of
/// smoothing matrix times correlation matrix, which stands in its place in Mallows' Cp.
double spent_on_shared_errors(const std::vector<double>& places, const std::vector<double>& strengths,
                              double correlation_mm);

/// The third derivative of values from place i to place i + 3.
double third_derivative_of(const std::vector<double>& places, const std::vector<double>& values,
                           std::size_t i);

/// 1-sigma of the noise of values at nearly even places, by the median of their third differences: what is
/// smooth over four points does not count.
double difference_noise(const std::vector<double>& values);

}  // namespace lightstripe
