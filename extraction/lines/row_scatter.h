// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How much the single rows across a line disagree about its centre: speckle, photon noise, stains and
// machining marks, whatever their cause.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// The error of a single row's centre as a stationary process along the line, in two parts: one that is
/// independent from row to row (the pixels' noise), and one with a correlation exp(-d^2 / (2 grain^2)) over d
/// px along the line (speckle, texture).
struct RowScatter {
  double white_variance = 0;  ///< px^2, across the line
  double row_px = 0.4;        ///< the independent part's grain: 1 / sqrt(2 pi) rows, px along the line
  double grain_variance = 0;  ///< px^2
  double grain_px = 1;
  double rows = 0;  ///< that were looked at

  /// Variance of a point whose kernel averages the rows by a Gaussian of `sigma` px along the line, px^2.
  double white_point(double sigma) const;
  double grained_point(double sigma) const;
  double of_point(double sigma) const { return white_point(sigma) + grained_point(sigma); }
  /// The grained part's variance of the mean over a stretch of the line, times the stretch's length, px^3.
  double grained_density() const;
};

/// Scratch memory.
struct RowScatterWorkspace {
  std::vector<float> offsets;  ///< px across the line, of each row; NaN between two stretches
  std::vector<float> squares;
};

/// Measures the scatter of one line in an image: each row's centre against the line, which the kernels have
/// smoothed, so that neither bends nor corners count. Fits the second differences of rows 1 to 6 apart. All
/// zero where the line has less than 24 usable rows.
template <class T>
RowScatter measure_row_scatter(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                               const LineRange& range, RowScatterWorkspace& workspace);

}  // namespace lightstripe
