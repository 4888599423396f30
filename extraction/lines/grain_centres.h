// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where a line lies in laser light with grain. Speckle is as strong as the light itself: on the bright
// middle, where the profile is flat and tells nothing about its place, it scatters most. The weights of least
// variance for the shift of a profile I(q) whose pixels have the variance c^2 I^2 + n^2 are I' / (c^2 I^2 +
// n^2) (weighted least squares); a derivative of a Gaussian, best for white noise, has up to twice their
// variance in strong grain.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"
#include "extraction/lines/row_crossing.h"
#include "extraction/lines/row_scatter.h"

namespace lightstripe {

/// Weights across a line, at steps of 1 / `per_px` px from -half to half steps.
struct GrainWeights {
  /// For the shift by the weights of least variance, its slope (what a shift of 1 px adds), and both for the
  /// kernels that found the line.
  using Tap = std::array<float, 4>;
  double per_px = 1;
  int half = 0;
  std::vector<Tap> taps;
};

/// `stripe`: standard deviation of the Gaussian profile, px. `noise`: n / (c I_0) for the peak I_0.
GrainWeights make_grain_weights(double stripe, const DerivativeKernels& kernels, double noise);

/// n / (c I_0) by what the rows of a line scatter by; nothing where the grain does not outweigh the noise.
std::optional<double> noise_over_grain(const RowScatter& scatter, double stripe, double sigma);

/// Scratch memory.
struct GrainWorkspace {
  struct Row {
    double shift = 0, slope = 0, old_shift = 0, old_slope = 0;  ///< sums over the taps
    double sign = 1;                                            ///< the normal's, along the row
    RowCrossing at;
    float centre = 0;      ///< px across the line, by the weights of least variance
    float difference = 0;  ///< less that by the line's own kernels
    bool usable = false;
    bool tells_scatter = false;  ///< the line is straight enough there
  };
  struct Move {
    double across = 0;  ///< px
    double share = 0;   ///< of the point's rows that are usable
  };
  std::vector<Row> rows;    ///< one a point of the line
  std::vector<Move> moves;  ///< likewise
  std::vector<float> along, values;
};

/// Moves the points of one line by what the rows' centres differ by the two kinds of weights, averaged along
/// the line as the kernels do; rows in sharp bends, beside the picture's border and far out of the others do
/// not count. `differences`: of the line's rows; they and `lines.recentred` become those of the moved line.
/// False, and nothing changes, where the rows do not agree better by the new weights.
template <class T>
bool recentre_in_grain(ImageView<T> image, const DerivativeKernels& kernels, const CommonScatter& common,
                       const LineRange& range, LineSet& lines, RowDifferences& differences,
                       GrainWorkspace& workspace, RowScatterWorkspace& rows);

}  // namespace lightstripe
