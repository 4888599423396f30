// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The direction-guided method: Chen, Zhang, Sun, "An efficient and accurate method for real-time processing
// of light stripe images", Adv. Mech. Eng. 2013, 456927, section 3.2, steps 2 to 5.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "extraction/exclusion_mask.h"
#include "extraction/kernels.h"
#include "extraction/line_set.h"

namespace lightstripe {

/// What a ridge must have to be followed. Strengths: -second derivative across, grey levels / px^2.
struct RidgeLimits {
  double level_low = 0;        ///< T_l, grey levels: no line begins below it
  double level_high = 0;       ///< T_h: lines begin here first
  bool hard_levels = false;    ///< given by the user: nothing below T_l is followed, no line begins below T_h
  double start_contrast = 1;   ///< grey levels over the surroundings, for a first point
  double start_strength = 0;   ///< for a first point
  double follow_strength = 0;  ///< for further points
  double shaded_strength = 0;  ///< for further points darker than T_l
  double strength_noise = 0;   ///< standard deviation of strengths by the image noise
  double clear_strength = 0;   ///< from here on the direction of one point is sure
  double relative_strength = 0.015;  ///< of the line's strongest recent point, for further points
  int largest_gap = 8;               ///< px, looked ahead along the direction before a line ends
  int largest_filled_gap = 4;        ///< px, gaps up to here get bridged points
};

/// One place where a line may begin.
struct LineSeed {
  std::int32_t x = 0, y = 0;
  std::int32_t rank = 0;  ///< contrast, 0..255 of the strongest
  bool foreground = false;
};

/// Buffers of the method, kept from frame to frame. One a thread.
template <class T>
struct DirectionGuidedWorkspace {
  ExclusionMask mask;
  std::vector<LineSeed> seeds, sorted_seeds;
  std::vector<std::uint64_t> candidate_masks;
  std::vector<T> zeros;
  std::vector<T> border_window;
  std::vector<StripePoint> backward;
};

/// Appends the lines of `image` to `lines` (x, y, normal, strength and flags are set), brightest first points
/// first. `brightest`: the image's largest grey level.
template <class T>
void follow_lines(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                  double brightest, DirectionGuidedWorkspace<T>& workspace, LineSet& lines);

}  // namespace lightstripe
