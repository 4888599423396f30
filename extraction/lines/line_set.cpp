// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_set.h"

#include <cmath>

namespace lightstripe {

void add_systematic_errors(LineSet& lines) {
  const bool has_systematic = lines.systematic.size() == lines.points.size(),
             has_fading = lines.fading.size() == lines.points.size();
  for (const LineRange& r : lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) {
      StripePoint& p = lines.points[i];
      const float systematic = has_systematic ? lines.systematic[i] : 0.0F,
                  fading = has_fading ? lines.fading[i] : 0.0F;
      const double square = double{systematic} * systematic + double{fading} * fading;
      const double own = p.sigma_px * p.sigma_px;
      if (square <= 0.01 * own) continue;
      p.sigma_px = std::sqrt(own + square);
      p.fade_px = fading;
    }
}

}  // namespace lightstripe
