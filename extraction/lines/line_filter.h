// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Whole lines on trial: what was followed is measured on the unsmoothed image, cut back to where it is really
// lit, mended over bright spots, and kept only if it behaves like a stripe over its whole length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_colour.h"
#include "extraction/lines/line_filter_options.h"
#include "extraction/lines/line_measure.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// A stretch of bad points, [first, last].
struct BadStretch {
  std::size_t first = 0, last = 0;
  bool spot = false;            ///< wider than the stripe; else unlit
  std::size_t other_light = 0;  ///< points that are lit, but not in the laser's colour
};

/// What a whole line is like.
struct LineFacts {
  double length = 0;          ///< px
  double width = 0;           ///< px, median
  double intensity = 0;       ///< grey levels, upper quartile
  double level = 0;           ///< grey value of the light and what it falls on, median
  double flatness = 0;        ///< median of the width at half height over the foot's; 0.68 on a Gaussian
  double clipped_share = 0;   ///< of the points
  double mean_strength = 0;   ///< grey levels / px^2
  double bridged_share = 0;   ///< of the points
  double odd_share = 0;       ///< bridged or asymmetric
  double flanks = 1;          ///< median of the smaller over the larger drop to both sides; an edge has 0
  bool colour_known = false;  ///< the picture tells where the laser's colour is
  double coloured_share = 1;  ///< of the points, where the laser's colour is
  LineColour colour;          ///< of the light that makes the line
  bool kept = true;           ///< verdict so far

  /// Px: what crumbs and edges lack in evenness counts as length that they have not.
  double even_length() const { return length * flanks * (1 - odd_share); }
};

/// The edges met among the lines, which drop on one side only.
struct EdgeCrowd {
  double length = 0;           ///< px
  double weighted_height = 0;  ///< grey levels times px
  double weighted_level = 0;   ///< grey values of the brighter sides times px
  double height() const { return length > 0 ? weighted_height / length : 0.0; }
  double level() const { return length > 0 ? weighted_level / length : 0.0; }
};

/// Lines of one scale.
struct FilteredLines {
  const DerivativeKernels* kernels = nullptr;
  LineSet* lines = nullptr;
  std::vector<LineFacts>* facts = nullptr;
};

/// Scratch memory.
struct LineFilterWorkspace {
  LineMeasures measure;
  std::vector<float> scratch;
  std::vector<BadStretch> stretches;
  EdgeCrowd edges;                   ///< added up over the scales of one image
  std::size_t tried = 0;             ///< lines that were followed, likewise
  std::vector<std::uint8_t> colour;  ///< one a point: LaserPlace
  ColourWorkspace colours;
  std::vector<LineRange> kept;
};

/// What is known of the image and of how its lines were looked for.
struct LineFilterRule {
  double noise = 0;      ///< grey levels
  double brightest = 0;  ///< grey level
  /// By how much more than max_width_ratio the measured width may differ from the kernels'; above 1 where the
  /// line's own strength chose the scale, since glow widens the foot of a stripe, not its core.
  double width_slack = 1;
};

/// Measures width, intensity and flags of every point, cuts the lines as said above and drops those that are
/// no stripes for themselves: the stripes' width follows from the kernels' sigma. `facts` gets one entry a
/// line that is left.
template <class T>
void filter_lines(ImageView<T> image, const DerivativeKernels& kernels, const LineFilterRule& rule,
                  const LineFilterOptions& options, LineFilterWorkspace& workspace, LineSet& lines,
                  std::vector<LineFacts>& facts);

/// Removes the lines (and their facts) that are not kept.
void drop_lines(LineSet& lines, std::vector<LineFacts>& facts);

}  // namespace lightstripe
