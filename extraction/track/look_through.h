// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The first look at a frame of which an earlier one is known: windows around the earlier lines and around
// whatever a coarse look over the whole frame sees.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"
#include "extraction/image/image_facts.h"
#include "extraction/track/search_windows.h"
#include "extraction/track/track_reference.h"

namespace lightstripe {

/// What a few places span, px.
struct PlaceExtent {
  float left = 1e9F, right = -1e9F, top = 1e9F, bottom = -1e9F;
  void add(const TrackedPlace& p) {
    left = std::min(left, p.x), right = std::max(right, p.x);
    top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  }
  float longer_side() const { return std::max(right - left, bottom - top); }
};

/// Scratch memory of tracking.
struct TrackWorkspace {
  SearchWindows windows;  ///< where lines are looked for
  SearchWindows seen;     ///< these and what coarse kernels read around them
  SearchWindows found;    ///< the cells of lines that were found
  std::vector<TrackedPlace> appeared;
  std::vector<std::uint8_t> cells;   ///< that hold places which appeared
  std::vector<PlaceExtent> extents;  ///< of the places in each cell
  std::vector<int> cluster;          ///< cells of one thing that appeared
  std::vector<std::uint64_t> masks;
};

/// Opens the windows and measures the frame: noise and histogram from the same sparse pixels as look_at(),
/// the brightest level in the windows and the rows of the coarse look. What appears opens windows where it is
/// at least `least_length` px long. Nothing where so much of the frame would be looked at that the full
/// search costs no more.
template <class T>
std::optional<ImageFacts> look_through(ImageView<T> image, const TrackReference& reference,
                                       double least_length, TrackWorkspace& workspace);

/// Of a pyramid over a frame with this noise, grey levels: white noise falls by half from level to level;
/// other noise by as much as in the earlier frame.
LevelNoise noise_of_levels(const TrackReference& before, double noise);

/// The coarsest level of a pyramid in which lines as wide as the reference's begin.
int coarsest_level(const TrackReference& reference);

/// Whether each line of the reference has found lines along at least half of it, and all that was found lies
/// where the image was looked at.
bool has_all_lines(const TrackReference& reference, const std::vector<Stripe>& stripes,
                   TrackWorkspace& workspace);

}  // namespace lightstripe
