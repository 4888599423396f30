// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Gaussian derivatives by recursive filters: the cost does not grow with sigma. Deriche 1993 in the form of
// Farneback and Westin, "Improving Deriche-style recursive Gaussian filters", J. Math. Imaging Vision 26,
// 2006.
#pragma once

#include "core/image.h"
#include "extraction/kernels/kernels_recursive.h"

namespace lightstripe {

/// A symmetric (order 0, 2) or antisymmetric (order 1) kernel as the sum of a filter that runs forward and
/// one that runs back.
struct RecursiveFilter {
  RecursiveWeights forward;   ///< inputs n, n-1, n-2, n-3
  RecursiveWeights backward;  ///< inputs n+1 ... n+4
  float sign = 1;             ///< of the backward part
  float settled_forward = 0;  ///< the forward part's answer to a constant 1
  float settled_backward = 0;
};

/// Derivative of order 0, 1 or 2 of a Gaussian, averaged over the pixel. Four decaying oscillations whose
/// rates are Farneback and Westin's; their amplitudes are fitted to the kernel, and its moments are made
/// exact: constants, ramps and (order 2) parabolas give their own derivatives.
RecursiveFilter make_recursive_filter(double sigma, int order);

/// Filters along the columns; border pixels are repeated. `out` gets the size of `in`.
void filter_columns(const Image<float>& in, const RecursiveFilter& filter, Image<float>& out);

void transpose(const Image<float>& in, Image<float>& out);

}  // namespace lightstripe
