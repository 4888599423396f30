// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Smoothing in two dimensions draws a bent line to its inner side; this puts it back.
#pragma once

#include <vector>

#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"
#include "extraction/lines/local_fit.h"

namespace lightstripe {

/// Scratch memory.
struct BendWorkspace {
  struct Shift {
    double x = 0, y = 0;  ///< px
    double left = 0;      ///< px: of what the parabola sees, what its noise leaves in doubt
    double noise = 0;     ///< of a point's variance, what the parabola's noise adds
  };
  std::vector<LocalFitPoint> nodes;  ///< one point in sigma of a stretch
  std::vector<Shift> shifts;         ///< of each node
};

/// Moves points by sigma^2 / 2 times the line's curvature to the outer side: the heat equation in polar
/// coordinates, f_t = (f_rr + f_r / r) / 2, drifts a ring of radius r inwards by sigma^2 / (2 r). The
/// curvature comes from a quadratic fit over about 3 sigma to both sides as far as it stands out of the
/// points' sigma_px, and for the rest from one over 9 sigma: in grain a gentle bend shows over a longer
/// stretch only. Adds its own error to `lines.systematic`, and what the parabola scatters to sigma_px.
void correct_curvature_bias(const DerivativeKernels& kernels, LineSet& lines, BendWorkspace& workspace);

}  // namespace lightstripe
