// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What makes a ridge of the grey-value surface a line, for all methods.
#pragma once

namespace lightstripe {

/// What a ridge must have to be followed. Strengths: -second derivative across, grey levels / px^2.
struct RidgeLimits {
  double level_low = 0;        ///< T_l, grey levels: no line begins below it
  double level_high = 0;       ///< T_h: lines begin here first
  bool hard_levels = false;    ///< given by the user: nothing below T_l is followed, no line begins below T_h
  double start_contrast = 1;   ///< grey levels over the surroundings, for a first point
  int seed_block = 1;          ///< px: first points are looked for in means of blocks of this size
  double start_strength = 0;   ///< for a first point
  double follow_strength = 0;  ///< for further points
  double shaded_strength = 0;  ///< for further points darker than T_l
  double strength_noise = 0;   ///< standard deviation of strengths by the image noise
  double grain = 0;            ///< of a strength: standard deviation by the grain of the line's light
  double clear_strength = 0;   ///< from here on the direction of one point is sure
  double relative_strength = 0.015;  ///< of the line's strongest recent point, for further points
  int largest_gap = 8;               ///< px, looked ahead along the direction before a line ends
  int largest_filled_gap = 4;        ///< px, gaps up to here get bridged points
};

}  // namespace lightstripe
