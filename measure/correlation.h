// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Neighbouring points of a stripe share errors: how many of them make one independent measurement, and what
// is left in a stretch of them.
#pragma once

#include <vector>

#include "measure/closest_points.h"

namespace lightstripe {

/// 1 + 2 sum of the autocorrelation of the residuals along the chains, up to the first lag where it is not
/// positive; at least 1. Points of weight 0 are left out, and the mean is not removed: an offset that a whole
/// chain shares is correlation.
double correlated_points(const Section& section, const std::vector<FitPoint>& points);

/// What the place of a short stretch of surface errs by, beyond its points' scatter: rms of the mean
/// residuals of stretches of some 8 mm of the chains. 0 with fewer than four stretches.
double stretch_error_mm(const Section& section, const std::vector<FitPoint>& points);

/// A point's error across the surface: a part of its own and one that it shares with its neighbours, by a
/// correlation of exp(-distance / length).
struct ErrorAlong {
  double own_mm = 0, shared_mm = 0;
  double length_mm = 1;
};

/// Fitted to the residuals' autocovariance along the chains, up to 16 mm. Points of weight 0 are left out.
ErrorAlong error_along(const Section& section, const std::vector<FitPoint>& points);

/// 1-sigma of the sum of errors, each times its factor, of points at `places` along the surface (mm, in any
/// order).
double sigma_of_sum(const ErrorAlong& error, const std::vector<double>& places,
                    const std::vector<double>& factors);

/// Covariance of the normal equations' right side (turn about the reference's origin; shift u, v), the
/// points' weights held: H^-1 (this) H^-1 is the pose's.
Eigen::Matrix3d gradient_covariance(const ErrorAlong& error, const Section& section,
                                    const std::vector<FitPoint>& points);

}  // namespace lightstripe
