// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What estimators use against outliers: order statistics and Tukey's weights. A median of nothing does not
// exist; what that means is the caller's to say.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <vector>

#include "core/error.h"

namespace lightstripe {

/// Times the median absolute deviation: the sigma of normal noise.
inline constexpr double kMadToSigma = 1.4826;

/// Times the median absolute second difference a - 2 b + c of independent values, whose sigma is sqrt(6)
/// times theirs: the sigma of normal noise.
inline constexpr double kSecondDifferenceToSigma = kMadToSigma / 2.449489743;

/// Tukey's biweight is 0 beyond this many sigmas; 95 % efficient for normal noise (Huber and Ronchetti 2009).
inline constexpr double kTukeyLimit = 4.685;

/// The value with this rank in rising order, 0 for the smallest. Reorders the values.
template <std::ranges::random_access_range Values>
auto value_at_rank(Values&& values, std::size_t rank) {
  LIGHTSTRIPE_CHECK(rank < std::size(values), "a rank beyond the values");
  const auto place = std::begin(values) + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(std::begin(values), place, std::end(values));
  return *place;
}

/// The value with the rank share * (n - 1), rounded down. Reorders the values.
template <std::ranges::random_access_range Values>
auto quantile(Values&& values, double share) {
  return value_at_rank(values, static_cast<std::size_t>(share * static_cast<double>(std::size(values) - 1)));
}

/// The median; of an even number the upper one of the two in the middle. Reorders the values.
template <std::ranges::random_access_range Values>
auto upper_median(Values&& values) {
  return value_at_rank(values, std::size(values) / 2);
}

/// The median; of an even number the mean of the two in the middle: of few values the upper one alone lies
/// too high.
inline double median(std::vector<double> values) {
  const double upper = upper_median(values);
  if (values.size() % 2 == 1) return upper;
  return (upper + *std::max_element(values.begin(),
                                    values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2))) /
         2;
}

/// Tukey's biweight of a residual over its scale: 1 at 0, 0 beyond kTukeyLimit.
inline double tukey_weight(double normalised) {
  const double t = normalised / kTukeyLimit;
  return std::abs(t) < 1 ? (1 - t * t) * (1 - t * t) : 0.0;
}

}  // namespace lightstripe
