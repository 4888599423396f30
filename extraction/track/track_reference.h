// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What one frame of a sequence leaves for those that follow: where its lines lie.
#pragma once

#include <cstddef>
#include <vector>

#include "extraction/follow/scale_ladder.h"

namespace lightstripe {

/// Every few pixels of a line a place, px.
struct TrackedPlace {
  float x = 0, y = 0;
};

struct TrackReference {
  int width = 0, height = 0;  ///< px, of the image; 0: there is no reference
  std::vector<TrackedPlace> places;
  std::vector<std::size_t> line_ends;  ///< places [line_ends[k - 1], line_ends[k]) are those of line k
  LevelNoise noise{};                  ///< grey levels, in each level of a pyramid; 0: was not measured
  double sigma = 0;                    ///< px, the scale of its widest line

  bool empty() const { return places.empty(); }
};

}  // namespace lightstripe
