// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the unsmoothed image says at each point of a line: width, intensity, saturation, asymmetry; and the
// predicted error.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Stride for statistics along a line; about 150 samples are enough.
inline std::size_t sample_step(const LineRange& r) { return 1 + r.size() / 150; }

/// What measure_points finds besides, and its scratch memory.
struct LineMeasures {
  std::vector<float> contrast;   ///< one a point: grey levels over the brighter side
  std::vector<double> averaged;  ///< one a line: how many neighbours' profiles were averaged
  std::vector<float> values, sums, profile;
};

/// Sets width, intensity and the flags of saturation and asymmetry of every point from its row's or column's
/// profile. Where a line hardly stands out of the `noise` (grey levels), profiles of neighbouring points are
/// averaged.
template <class T>
void measure_points(ImageView<T> image, const DerivativeKernels& kernels, double noise, LineSet& lines,
                    LineMeasures& measures);

/// Widths and intensities become means along the line over about the kernels' own reach, bridged points
/// excepted.
void smooth_measures(const DerivativeKernels& kernels, LineSet& lines, std::vector<float>& scratch);

}  // namespace lightstripe
