// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_set.h"

#include <cmath>

namespace lightstripe {

void add_systematic_errors(LineSet& lines) {
  if (lines.systematic.size() != lines.points.size()) return;  // not known
  for (const LineRange& r : lines.lines)
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const double error{lines.systematic[i]};
      if (error > 0.1 * lines.points[i].sigma_px)
        lines.points[i].sigma_px =
            std::sqrt(lines.points[i].sigma_px * lines.points[i].sigma_px + error * error);
    }
}

}  // namespace lightstripe
