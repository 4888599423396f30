// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The grey-value methods: in every column (row) one centre of each bright run. Fast and simple, for stripes
// that cross the columns (rows) steeply on a dark background.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/follow/ridge_limits.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

enum class GreyValueCentre {
  kCentroid,  ///< mean place, the grey value over T_l weighs
  kExtremum,  ///< peak of the run smoothed by a Gaussian of the stripe's scale
};

/// A run of pixels over T_l.
struct BrightRun {
  double centre = 0;  ///< px along the column (row)
  double half = 0;    ///< px
  double peak = 0;    ///< grey levels over T_l
};

/// Scratch memory.
struct GreyValueWorkspace {
  struct OpenLine {
    int number = 0;
    double centre = 0, half = 0;
    bool extended = true;
  };
  std::vector<BrightRun> runs;
  std::vector<OpenLine> open;
  std::vector<StripePoint> points;
  std::vector<int> numbers;          ///< the line of each point
  std::vector<std::size_t> offsets;  ///< where each line's points begin
};

/// Columns are taken where the bright pixels' runs are shorter down the columns than along the rows, else
/// rows. Runs of neighbouring columns that touch make one line.
template <class T>
void find_lines_by_grey_value(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                              GreyValueCentre centre, GreyValueWorkspace& workspace, LineSet& lines);

}  // namespace lightstripe
