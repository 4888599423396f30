// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which picture of which sensor belongs to which frame, also where pictures are missing.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/images.h"

namespace lightstripe {

/// The running numbers in file names that differ in nothing else ("img_007.png" -> 7); empty where the names
/// differ otherwise or have no number.
std::vector<std::int64_t> numbers_in_names(const std::vector<std::string>& names);

/// Frames [first, end) of a recording.
struct FrameMap {
  std::int64_t first = 0, end = 0;
  /// Of each source and each frame from `first` on: the index in the source, -1 where its picture is missing.
  std::vector<std::vector<std::int32_t>> index;
  std::vector<std::string> duplicate_pictures;  ///< pictures left out because another one has the same number
  std::int64_t number_step = 1;                 ///< of the pictures' numbers from one frame to the next
  /// The sources' numbers begin apart and none has a gap: the n-th pictures were taken as one frame, which
  /// the user should confirm.
  bool paired_by_order = false;
  /// Of each frame from `first` on, where the numbers are time stamps that the travel table is keyed by as
  /// well; else empty.
  std::vector<std::int64_t> stamps;

  std::int32_t index_of(std::size_t source, std::int64_t frame) const {
    return index[source][static_cast<std::size_t>(frame - first)];
  }
};

/// Frame n is the n-th picture, counted from 0, and a gap in the pictures' running numbers is a frame whose
/// picture is missing. `positions`: the frames that a travel table knows, ascending, empty without one; where
/// its frames fit the numbers as they stand at least as well as the numbers counted from the lowest, the
/// number is the frame. Several sources of one length without a gap whose numbers begin apart are paired by
/// order, unless the table fits their numbers better. Numbers too sparse to be running ones (time stamps), or
/// none, leave the order only: then all sources must have the same size, else an Error naming `subject`;
/// where the table's numbers span the pictures' they are the stamps, and pictures of one stamp are one frame
/// where the cameras' clocks agree. Null sources have no pictures.
FrameMap map_frames(std::span<const FrameSource* const> sources, const std::vector<std::int64_t>& positions,
                    const std::string& subject);

}  // namespace lightstripe
