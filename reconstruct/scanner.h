// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A recorded scan -> profiles in order: frames are read, extracted and triangulated in parallel,
// a bounded number at a time; the results do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/profile.h"
#include "core/rig.h"
#include "extraction/extract_stripes.h"
#include "reconstruct/triangulate.h"

namespace lightstripe {

struct ScanInput {
  std::int64_t num_frames = 0;
  /// The picture of one rig sensor in one frame (called from several threads); nothing where this sensor has none.
  std::function<std::optional<Image8>(std::int64_t frame, int sensor)> read;
  /// Where the rig stood; nothing where it is not known (the frame is left out and counted).
  std::function<std::optional<FramePosition>(std::int64_t frame)> position;
};

struct ScanSummary {
  std::int64_t frames = 0;           ///< handed on
  std::int64_t frames_without_position = 0;
  std::int64_t frames_without_points = 0;
  std::int64_t points = 0;
  std::int64_t rays_missed = 0;
};

/// Calls `sink` once a frame in order of frames, from one thread at a time. `threads` = 0: all cores.
/// An exception of `read` or `sink` ends the run and comes out here.
ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const ExtractionOptions& extraction, int threads,
                          const std::function<void(const Profile&)>& sink);

}  // namespace lightstripe
