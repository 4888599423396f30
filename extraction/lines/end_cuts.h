// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// In grain the kernels are wider than the stripe, and near the end of a line they look past it: over the
// dark, and round the bend where the light ends on a body's edge. Cuts across the line look at nothing but
// their own place.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Scratch memory.
struct EndCutWorkspace {
  /// What a Gaussian as wide as the stripe and its derivatives see of a cut, at one place of it.
  struct Tap {
    float light = 0;  ///< weight of the light
    float shift = 0;  ///< of its shift
    float slope = 0;  ///< of what a shift of one standard deviation adds
  };
  struct Cut {
    float centre = 0;            ///< px across the line from its point; NaN: no light there
    float slope = 0, light = 0;  ///< sums over the taps: their ratio tells how narrow the light is
  };
  std::vector<Tap> taps;
  std::vector<Cut> cuts;     ///< of one end
  std::vector<float> along;  ///< weights of neighbouring cuts, by their distance
  std::vector<float> values;
};

/// Moves the points within four sigma of both ends towards the mean of the cuts around them, by as much as
/// that mean stands out of the cuts' own scatter (James and Stein, Proc. 4th Berkeley Symp. 1, 1961, for one
/// place): the scatter, and what the cuts see otherwise than the kernels all along the line, is that of cuts
/// further in, of which neighbours share `grain_px` (CommonScatter). Where the light in the cuts is narrower
/// than there, the end has cut it off obliquely, and the rest is not trusted as far as that shifts it.
/// sigma_px becomes that of both together. Lines stay whose cuts hardly scatter (line_ends.h knows their ends
/// better), those that are too short to know, and ends where the line leaves the picture.
template <class T>
void recentre_ends(ImageView<T> image, const DerivativeKernels& kernels, double grain_px, LineSet& lines,
                   EndCutWorkspace& workspace);

}  // namespace lightstripe
