// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The grey-value methods: in every column or row one centre of each bright run. Fast and simple, for stripes
// that are the brightest thing around.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/follow/ridge_limits.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

enum class GreyValueCentre {
  kCentroid,  ///< mean place, the grey value over the run's level weighs
  kExtremum,  ///< peak of the run smoothed by a Gaussian of the stripe's scale
};

/// A run of pixels over T_l, or over a higher level where that one is too long to be a stripe.
struct BrightRun {
  double centre = 0;  ///< px along the column (row)
  double half = 0;    ///< px
  double peak = 0;    ///< grey levels over the run's level
};

/// Scratch memory.
struct GreyValueWorkspace {
  struct OpenLine {
    int number = 0;
    std::size_t point = 0;  ///< its last one
    double centre = 0, half = 0;
    bool extended = true;
  };
  std::vector<BrightRun> runs;
  std::vector<OpenLine> open;
  std::vector<StripePoint> points;
  std::vector<int> numbers;          ///< the line of each point
  std::vector<std::size_t> offsets;  ///< where each line's points begin
  LineSet found;                     ///< along one axis
  std::vector<char> well_crossed;    ///< of the points of one line
};

/// Runs of neighbouring columns that touch make one line, and so do runs of neighbouring rows. Each line is
/// taken from the axis that crosses it at less than 45 degrees; a line that bends further is taken in parts.
template <class T>
void find_lines_by_grey_value(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                              GreyValueCentre centre, GreyValueWorkspace& workspace, LineSet& lines);

}  // namespace lightstripe
