// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How much the single rows across a line disagree about its centre: speckle, photon noise, stains and
// machining marks, whatever their cause.
#pragma once

#include <array>
#include <cstddef>
#include <span>
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

/// How much the rows of one line differ, as it is seen.
struct RowDifferences {
  static constexpr std::size_t kLags = 6;
  std::array<double, kLags>
      seen{};  ///< px^2: a sixth of the mean squared second difference, 1, 2 ... rows apart
  std::array<double, kLags> white{};  ///< what independent rows of variance 1 would show there
  double rows = 0;                    ///< that were looked at; 0: too few
  double sigma = 1;                   ///< px, of the kernels
  double step = 1;                    ///< px along the line from row to row
  double white_factor = 1;            ///< of an independent variance, for rows that cross the line obliquely
};

/// Scratch memory.
struct RowScatterWorkspace {
  std::vector<float> offsets;  ///< px across the line, of each row; NaN between two stretches
  std::vector<float> squares;
  struct Run {
    std::size_t begin = 0, end = 0;
  };
  std::vector<Run> runs;  ///< of offsets without a gap
};

/// Looks at one line in an image: each row's centre against the line, which the kernels have smoothed, so
/// that neither bends nor corners count.
template <class T>
RowDifferences look_at_rows(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                            const LineRange& range, RowScatterWorkspace& workspace);

/// What `workspace.offsets` of one line show: rows in order, px across the line against the mean of their
/// neighbours by a Gaussian of `sigma` px along it, NaN where one does not follow the other. `cosine`: mean
/// of the angle between the rows and the line's normal.
RowDifferences differences_of_rows(double sigma, double cosine, RowScatterWorkspace& workspace);

/// What the lines of one picture share: the grain is that of the lens, and its variance grows as the width.
struct CommonScatter {
  double grain_px = 0;      ///< 0: the rows are independent
  double grain_per_px = 0;  ///< grained variance over the kernels' sigma, px
};

/// One line alone has too few rows to tell its grain for sure.
CommonScatter common_scatter(std::span<const RowDifferences> lines);
/// The same where the grain is known.
CommonScatter common_scatter(std::span<const RowDifferences> lines, double grain_px);

/// Fits the differences of one line by the common grain. A short line's grained variance leans on the common
/// one; a line with less than 24 usable rows has nothing else.
RowScatter fit_scatter(const RowDifferences& line, const CommonScatter& common);

/// Both for a line that is alone.
template <class T>
RowScatter measure_row_scatter(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                               const LineRange& range, RowScatterWorkspace& workspace);

}  // namespace lightstripe
