// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The direction-guided method: Chen, Zhang, Sun, "An efficient and accurate method for real-time processing
// of light stripe images", Adv. Mech. Eng. 2013, 456927, section 3.2, steps 2 to 5.
#pragma once

#include <vector>

#include "core/image.h"
#include "extraction/follow/direction_guided_step.h"
#include "extraction/follow/exclusion_mask.h"
#include "extraction/follow/line_seeds.h"
#include "extraction/follow/patience.h"
#include "extraction/follow/ridge_limits.h"
#include "extraction/kernels/kernels.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

/// Buffers of the method, kept from frame to frame. One a thread.
template <class T>
struct DirectionGuidedWorkspace {
  ExclusionMask mask;
  SeedWorkspace seeds;
  Image<T> binned;
  std::vector<T> border_window;
  std::vector<StripePoint> backward;
  SearchPatience patience;
};

/// Where following begins and when it may stop.
struct FollowRule {
  double brightest = 0;  ///< the image's largest grey level
  bool has_start = false;
  double start_x = 0, start_y = 0;  ///< px: the first line begins at the ridge nearest to this place
  int stop_after = 0;               ///< lines of at least `least_length` px; 0 = never
  double least_length = 0;          ///< px; what is shorter is a crumb
};

/// Follows the line whose ridge is near pixel (x, y) to both ends, marks it in the workspace's mask and
/// appends it to `lines`; false where no line begins or another one has the place.
template <class T>
bool follow_line_at(const RidgeFinder<T>& finder, int x, int y, MaskLabels& labels,
                    DirectionGuidedWorkspace<T>& workspace, LineSet& lines);

/// Appends the lines of `image` to `lines` (x, y, normal, strength and flags are set), brightest first points
/// first, until a crowd of crumbs says that no more will come (patience.h).
template <class T>
void follow_lines(ImageView<T> image, const DerivativeKernels& kernels, const RidgeLimits& limits,
                  const FollowRule& rule, DirectionGuidedWorkspace<T>& workspace, LineSet& lines);

}  // namespace lightstripe
