// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Less scatter by the neighbours along the line, without bending it.
#pragma once

#include <cstddef>
#include <vector>

#include "extraction/lines/line_set.h"
#include "extraction/lines/local_fit.h"

namespace lightstripe {

/// Scratch memory.
struct SmoothingWorkspace {
  struct Estimate {
    double x = 0, y = 0;
    double variance = 1;  ///< against one point's own
    double bend = 0;      ///< squared bias that the wider window may have, likewise
    bool growing = true;  ///< no window was too wide yet
  };
  std::vector<Estimate> current, wider;
  std::vector<double> misfit;  ///< running sums of squared differences over their expectation
  std::vector<int> telling;    ///< running count of those differences
  std::vector<LocalFitPoint> places;
};

/// Each point moves to the least-squares parabola through its neighbours along the line. The window grows by
/// doubling as long as the wider parabola differs from the narrower one by no more than the points' own
/// correlated scatter explains (Lepski's rule: Lepski, Mammen, Spokoiny, Ann. Statist. 25, 1997; the
/// differences pooled over the window): far along a straight line, hardly at all in a bend. Gaps and long
/// bridges end a window. sigma_px falls accordingly; it and LineRange::shared_px must be known.
void smooth_along_lines(LineSet& lines, SmoothingWorkspace& workspace);

}  // namespace lightstripe
