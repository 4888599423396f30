// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A recorded scan -> profiles in order: frames are read, extracted and triangulated in parallel,
// a bounded number at a time; the results do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/picture.h"
#include "core/profile.h"
#include "core/rig.h"
#include "extraction/extract_stripes.h"
#include "reconstruct/frame_ranges.h"
#include "reconstruct/triangulate.h"

namespace lightstripe {

/// A picture that could not be used, and why: "gauge, frame 7: ...".
struct SkippedPicture {
  int sensor = 0;
  std::string reason;
};

/// How much of a scan is done.
struct ScanCounts {
  std::int64_t frames = 0;  ///< handed on
  std::int64_t frames_without_points = 0;
  std::int64_t points = 0;
  std::int64_t rays_missed = 0;
  std::int64_t pictures = 0;  ///< that were read and looked at
  std::int64_t pictures_skipped = 0;
};

/// How wide one line is: the median of its points' widths.
struct LineWidth {
  int sensor = 0, points = 0;
  double width_px = 0;
};

LineWidth line_width(int sensor, std::span<const StripePoint> points);

/// One frame on its way to the sink.
struct ScannedFrame {
  Profile profile;
  bool travel_interpolated = false;
  int pictures = 0;  ///< that were read and looked at
  std::vector<SkippedPicture> skipped;
  std::vector<LineWidth> lines;
  std::vector<std::string> encoded;  ///< what ScanInput::encode made of the profile
  ScanCounts counts;                 ///< of the scan up to and with this frame; not yet known to `encode`
};

struct ScanSummary : ScanCounts {
  FrameRanges without_position;
  FrameRanges interpolated;             ///< their travel lies between two readings
  bool stopped = false;                 ///< ended by ScanInput::stop
  std::vector<OutsideRange> outside{};  ///< by sensor; of this run alone, without `before`
};

struct ScanInput {
  std::int64_t first_frame = 0;
  std::int64_t end_frame = 0;  ///< the first one that is not scanned
  /// The picture of one rig sensor in one frame (called from several threads); nothing where this sensor has
  /// none in the whole scan. An Error skips this picture only, unless `strict`.
  std::function<std::optional<Picture>(std::int64_t frame, int sensor)> read;
  /// Where the rig stood; nothing where it is not known (the frame is left out and counted).
  /// Called in order of frames, from one thread at a time.
  std::function<std::optional<FramePosition>(std::int64_t frame)> position;
  /// False for frames that were never recorded (numbers that the recording leaves out): passed over silently.
  std::function<bool(std::int64_t frame)> recorded{};
  /// Work on the finished profile that needs no order, such as making text of it; called from several
  /// threads.
  std::function<void(ScannedFrame& frame)> encode{};
  /// A picture that cannot be read, or has not the size of the rig's camera, ends the run.
  bool strict = false;
  /// What an earlier run has done of this scan: counts and ranges go on from here.
  ScanSummary before{};
  /// A stop that is asked for ends the run after the frames that are under way.
  std::stop_token stop{};
};

/// image of one sensor -> its stripes; called from several threads.
using StripeExtractor = std::function<std::vector<Stripe>(const GreyImage&)>;
using FrameSink = std::function<void(const ScannedFrame&)>;

/// Calls `sink` once a frame in order of frames, from one thread at a time; a frame without points gives an
/// empty profile. `threads` = 0: all cores. A picture that `read` refuses by an Error, or of another size
/// than the rig's camera, is skipped and named in its frame; with `strict`, and for every other exception of
/// `read`, `position`, the extractor, `encode` or `sink`, the run ends and the exception comes out here;
/// where several frames fail, that of the first one. At most one picture a thread and two profiles a thread
/// are alive at any time.
ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const StripeExtractor& extract, int threads,
                          const FrameSink& sink);

/// The same with extract_stripes(), which keeps one workspace a thread; where `extraction.track` is set with
/// track_stripes() by the key frame of each frame (its number down to a multiple of kTrackedFrames), which is
/// read also where it lies before `first_frame`: so parts of a scan give the bits of the whole.
ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const ExtractionOptions& extraction,
                          int threads, const FrameSink& sink);

}  // namespace lightstripe
