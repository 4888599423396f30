// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A recorded scan -> profiles in order: frames are read, extracted and triangulated in parallel,
// a bounded number at a time; the results do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
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
  /// The picture of one rig sensor in one frame (called from several threads); nothing where this sensor has
  /// none.
  std::function<std::optional<Image8>(std::int64_t frame, int sensor)> read;
  /// Where the rig stood; nothing where it is not known (the frame is left out and counted).
  /// Called in order of frames, from one thread at a time.
  std::function<std::optional<FramePosition>(std::int64_t frame)> position;
  /// A stop that is asked for ends the run after the frames that are under way.
  std::stop_token stop{};
};

struct ScanSummary {
  std::int64_t frames = 0;  ///< handed on
  std::int64_t frames_without_position = 0;
  std::int64_t frames_without_points = 0;
  std::int64_t points = 0;
  std::int64_t rays_missed = 0;
  bool stopped = false;  ///< ended by ScanInput::stop
};

/// image of one sensor -> its stripes; called from several threads.
using StripeExtractor = std::function<std::vector<Stripe>(ImageView8)>;

/// Calls `sink` once a frame in order of frames, from one thread at a time; a frame without points gives an
/// empty profile. `threads` = 0: all cores. An exception of `read`, `position`, the extractor or `sink` ends
/// the run and comes out here; where several frames fail, that of the first one. An Error names the frame
/// where a picture has another size than the rig's camera. At most one picture a thread and two profiles a
/// thread are alive at any time.
ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const StripeExtractor& extract, int threads,
                          const std::function<void(const Profile&)>& sink);

/// The same with extract_stripes().
ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const ExtractionOptions& extraction,
                          int threads, const std::function<void(const Profile&)>& sink);

}  // namespace lightstripe
