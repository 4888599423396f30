// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The last points of a line: half of what the kernels see there is dark, and a stripe that is cut off
// obliquely is drawn aside.
#pragma once

#include <vector>

#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Scratch memory.
struct LineEndWorkspace {
  /// One of the points that tell how a line goes on.
  struct Point {
    double u = 0, across = 0;  ///< along the line from a whole point on, in sigmas of the kernels; px across
    double shift = 0;          ///< px, by a cut at 45 degrees
    double scatter = 0;        ///< px, 1 sigma
  };
  std::vector<Point> points;
};

/// Whether the line runs over print, which makes its strength tell less of its end: then no point is moved.
enum class EndsOnPrint { kNo, kYes };

/// Where the strength of a line's last points falls as the light's end lets it (light_end.h), these points
/// and those further in together tell the line, a parabola, and the tangent of the cut, which has drawn the
/// last ones aside: a least-squares fit in which each point has its noise, and the shift by the cut its own
/// error. The disturbed points move onto that line; sigma_px is the fit's. Of a line that is too short for
/// it, or that no cut explains, only sigma_px grows, by what a cut at 45 degrees does.
void mend_line_ends(const DerivativeKernels& kernels, EndsOnPrint on_print, LineSet& lines,
                    LineEndWorkspace& workspace);

}  // namespace lightstripe
