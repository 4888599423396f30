// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where in a colour picture the laser's light is, told by its colour; inside src/io.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace lightstripe {

using ColourPlanes = std::array<cv::Mat, 3>;  ///< 8 bits each: B, G, R

/// The larger of the other two planes as it would be if the light around had no more of it than of `plane`:
/// a wrong white balance hides a laser, as blue light around hides a red one.
cv::Mat larger_other(const ColourPlanes& bgr, std::size_t plane);

/// How far one plane rises over the larger of the other two, against the mean of the surroundings, so that
/// neither a wrong white balance nor a large coloured thing counts.
struct ColourRise {
  cv::Mat level;     ///< CV_16S, grey levels
  cv::Mat bleached;  ///< CV_8U, 0 or 255: as bright as any place around, and less coloured
  double noise = 0;  ///< its usual level, 1 sigma, grey levels
  double top = 0;    ///< level that the brightest 0.02 % of the pixels reach
};
ColourRise colour_rise(const ColourPlanes& bgr, std::size_t plane);

/// What colour tells of each pixel.
struct LaserColour {
  std::vector<std::uint8_t> where;  ///< LaserPlace
  std::vector<std::uint8_t> rise;   ///< ColourRise's level, at most 254 grey levels, or kClippedRise
};

/// `where`: pixels that rise by a fifth of the top are sure, those that rise out of the
/// noise faint; a clipped white core belongs to the coloured rim around it; both are widened by 4 px.
LaserColour where_laser_colour(const ColourPlanes& bgr, std::size_t plane);

/// What speaks for a laser of one colour in a picture.
struct LaserVote {
  int plane = -1;         ///< 0, 1, 2 for B, G, R; -1: the picture shows no line of light that has a colour
  double score = 0;       ///< length times contrast of what is line-like in this colour
  bool clipped = false;   ///< the plane is clipped along a good part of the line
  bool textured = false;  ///< unclipped, and what it falls on varies by more than half of its own light
};
/// Votes for what is line-like, not for what is colourful.
LaserVote vote_for_laser(const ColourPlanes& bgr);

}  // namespace lightstripe
