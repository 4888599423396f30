// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The lines under work between following and the final stripes: points in one array, lines as ranges of it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/stripe.h"

namespace lightstripe {

/// Points [begin, end) of LineSet::points, in order along the line. Not every point need belong to a line.
struct LineRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  double shared_px = 0;  ///< length along the line over which its points share one error; 0: not known yet
  std::size_t size() const { return end - begin; }
};

struct LineSet {
  std::vector<StripePoint> points;
  std::vector<LineRange> lines;
  std::vector<float>
      half_level_widths;          ///< px, one a point once they are measured: full width at half the peak
  std::vector<float> systematic;  ///< px, 1 sigma, one a point once known: what neighbours share, not scatter
  std::vector<float> fading;      ///< px, 1 sigma, one a point once known: by find_fade_errors()
  std::vector<float> recentred;   ///< one a point or none: the share of its rows that grain_centres weighed

  void clear() {
    points.clear();
    lines.clear();
    half_level_widths.clear();
    systematic.clear();
    fading.clear();
    recentred.clear();
  }
};

/// Adds `lines.systematic` and `lines.fading` to the points' sigma_px, the latter as their fade_px. After
/// smoothing, which takes sigma_px for scatter.
void add_systematic_errors(LineSet& lines);

}  // namespace lightstripe
