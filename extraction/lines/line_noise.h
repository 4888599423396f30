// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How noisy the light of a stripe is: photon noise grows with the light, and the background does not show it.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/grain_centres.h"
#include "extraction/lines/line_set.h"
#include "extraction/lines/row_scatter.h"

namespace lightstripe {

/// Standard deviation of the pixel noise on the ridge of one line, grey levels: the median second difference
/// of the brightest pixels along it, the sub-pixel place of each made good. Nothing but `background_noise`
/// where too few neighbouring points are unclipped.
template <class T>
double noise_on_ridge(ImageView<T> image, const LineSet& lines, const LineRange& range,
                      double background_noise, std::vector<float>& scratch);

/// Scratch memory.
struct ErrorWorkspace {
  RowScatterWorkspace rows;
  std::vector<RowDifferences> differences;  ///< of all lines of the picture, in order
  CommonScatter common;
  std::vector<RowDifferences> by_kernels;  ///< before recentre_lines(); empty without it
  CommonScatter common_by_kernels;
  GrainWorkspace grain;
  std::size_t next = 0;  ///< of the differences, that predict_errors() comes to
  std::vector<float> values;
};

/// Looks at the rows of each line; all lines of a picture come before common_scatter() and predict_errors(),
/// which takes them in the same order.
template <class T>
void look_at_scatter(ImageView<T> image, const DerivativeKernels& kernels, const LineSet& lines,
                     ErrorWorkspace& workspace);

/// Moves the lines to the centres of least variance in grain (see grain_centres.h) and looks at their rows
/// anew. All lines of a picture come before common_scatter() once more.
template <class T>
void recentre_lines(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines,
                    ErrorWorkspace& workspace);

/// Sets sigma_px of every point: the camera's noise by the point's strength, and the scatter of the rows
/// along its line (photon noise, speckle, texture); of bridged points also how far they run beside light that
/// may be the line's: what sigma_px says of it already (a bridge over a spot), else what the image shows.
template <class T>
void predict_errors(ImageView<T> image, const DerivativeKernels& kernels, double background_noise,
                    LineSet& lines, ErrorWorkspace& workspace);

}  // namespace lightstripe
