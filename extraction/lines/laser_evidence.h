// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whether a picture's lines are a laser's, or the strongest of the things in a picture with the laser off.
#pragma once

#include <span>

#include "extraction/lines/line_filter.h"

namespace lightstripe {

/// What speaks for a line in a whole picture, px times grey levels: how long and even it is, times the light
/// that it adds in the laser's colour.
double light_of_line(const LineFacts& line);

/// Whether the kept lines are what the picture shows, and not the strongest of the things in it, or the
/// longest crumbs of a texture: the more speaks for other things, the more has to speak for the lines, and
/// one of them has to be `least_widths` long and even. `bars`: what speaks for dropped flat bars; `extent`:
/// px, the picture's width + height.
bool shows_laser(std::span<const FilteredLines> groups, const EdgeCrowd& edges, double bars, double extent,
                 double least_widths);

}  // namespace lightstripe
