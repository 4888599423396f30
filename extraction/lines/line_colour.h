// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Is a line made of the laser's light? In a colour picture the laser's colour rises at its line together with
// the brightness. The edge of a printed square or of a board, lit by the laser's glow, is brighter than what
// lies beside it, but no more coloured.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// What the colour tells of a whole line.
struct LineColour {
  bool known = false;  ///< the picture has colours, and most of the line is not clipped
  double rise = 0;     ///< grey levels, median over the line: rise of the colour over both sides
  double share = 1;    ///< median of that rise over the rise of the grey value
};

/// Rise of the laser's colour over the rise of the grey value: with less a line is doubtful.
constexpr double kUsualColour = 0.2;

/// Scratch memory.
struct ColourWorkspace {
  std::vector<float> rises, shares;  ///< of the points of one line; NaN where they are clipped
  std::vector<float> scratch;
};

/// `width`: of the line, px; the points' intensities are measured already.
template <class T>
LineColour colour_of_line(ImageView<T> image, const LineSet& lines, const LineRange& range, double width,
                          ColourWorkspace& workspace);

/// Sets `place[i]` of each of the line's points i: LaserPlace as the image has it, or kOtherLight where
/// following went astray along an edge in other light: both the rise of the colour and its share fall far
/// below those of the line.
template <class T>
void place_points(ImageView<T> image, const LineSet& lines, const LineRange& range, double width,
                  ColourWorkspace& workspace, std::vector<std::uint8_t>& place);

}  // namespace lightstripe
