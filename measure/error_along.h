// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a section's points err by, each by itself and together with its neighbours, and what that makes of
// sums of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "measure/closest_points.h"

namespace lightstripe {

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

/// Where a sample of a fit lies: mm along the surface, and on which stripe.
struct PlaceOnStripe {
  double along_mm = 0;
  int chain = 0;
};

/// The same of points on several stripes, which share nothing with each other.
double sigma_of_sum(const ErrorAlong& error, const std::vector<PlaceOnStripe>& places,
                    const std::vector<double>& factors);

/// The error where points scatter by `here_mm` about a fit of `count` of them: clearly more than the
/// section's points elsewhere is their own.
ErrorAlong where_points_scatter(const ErrorAlong& error, double here_mm, int count);

/// Covariance of the normal equations' right side (turn about the reference's origin; shift u, v), the
/// points' weights held: H^-1 (this) H^-1 is the pose's.
Eigen::Matrix3d gradient_covariance(const ErrorAlong& error, const Section& section,
                                    const std::vector<FitPoint>& points);

}  // namespace lightstripe
