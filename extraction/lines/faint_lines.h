// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The lines of one image judged against each other: which of them are too faint, too short and too irregular
// to be the laser's, if the strong ones are.
#pragma once

#include <span>

#include "extraction/lines/line_filter.h"
#include "extraction/lines/line_filter_options.h"

namespace lightstripe {

/// What a line needs besides its strength in proportion to the others.
struct FaintLineRule {
  double noise = 0;         ///< grey levels, of the image
  double width_slack = 1;   ///< as in filter_lines; above 1 the evidence for each line is judged as well
  double least_height = 0;  ///< grey levels: the strongest line counts as at least so bright
  double range_end = 0;     ///< grey level from which on the camera may have clipped
  double extent = 0;        ///< px, the picture's width + height; 0: somebody knows that a line is there
};

/// Drops the lines that are too faint against the strong ones of the same image, whatever their scale. A line
/// that begins where a kept one ends needs less evidence: the laser's line dims and is interrupted, but it
/// goes on. All of them are dropped where little speaks for them, and more for other things: something is
/// always the strongest in a picture with the laser off.
void drop_faint_lines(std::span<const FilteredLines> groups, const LineFilterOptions& options,
                      const FaintLineRule& rule, const EdgeCrowd& edges);

}  // namespace lightstripe
