// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the unsmoothed image says at each point of a line: width, intensity, saturation, asymmetry; and the
// predicted error.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/kernels.h"
#include "extraction/line_set.h"

namespace lightstripe {

/// Median of the values (their order is changed); 0 for none.
double median_of(std::vector<float>& values);

/// Sets width, intensity and the flags of saturation and asymmetry of every point from its row's or column's
/// profile; `contrast` gets the grey levels over the brighter side for each point.
template <class T>
void measure_points(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines,
                    std::vector<float>& contrast);

/// Widths and intensities become means along the line over about the kernels' own reach, bridged points
/// excepted.
void smooth_measures(const DerivativeKernels& kernels, LineSet& lines, std::vector<StripePoint>& scratch);

/// Sets sigma_px of every point from its strength and the noise of the image.
void predict_errors(const DerivativeKernels& kernels, double noise, LineSet& lines);

}  // namespace lightstripe
