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

/// Distance along the stripes over which the correlation of the residuals falls to 1/e, mm: the short part,
/// what the extraction and the speckle share. correlated_points() is larger: it has also the slow part, a
/// bias of some microns that a whole face has in common (a tenth to a fifth of the variance where the scatter
/// is 5 microns), which is an error of the registration but no waviness.
double correlation_length_mm(const Section& section, const std::vector<FitPoint>& points);

/// What the place of a short stretch of surface errs by, beyond its points' scatter: rms of the mean
/// residuals of stretches of some 8 mm of the chains. 0 with fewer than four stretches.
double stretch_error_mm(const Section& section, const std::vector<FitPoint>& points);

}  // namespace lightstripe
