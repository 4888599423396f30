// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A camera -> a folder that a scan file can name: pictures, frames.csv, travel.csv, record.yaml.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "io/live_source.h"
#include "io/picture_recorder.h"
#include "io/session_file.h"

namespace lightstripe {

/// How a frame's travel follows from what came with it; at most one.
struct LiveTravel {
  std::optional<double>
      mm_per_count;                ///< by the encoder's count in the chunk data, from the first frame's on
  std::optional<double> mm_per_s;  ///< by the camera's clock (or that of the arrival where it has none)
  std::optional<double> step_mm;   ///< by the frame's number: an external trigger by way
  bool any() const { return mm_per_count || mm_per_s || step_mm; }
};

/// Travel of one frame after the other; nothing where it is not known.
class TravelOfFrames {
 public:
  explicit TravelOfFrames(const LiveTravel& travel) : travel_(travel) {}
  std::optional<double> at(const LiveFrame& frame);

 private:
  LiveTravel travel_;
  std::optional<double> first_count_, first_ns_;
};

struct RecordJob {
  std::string source;
  std::filesystem::path folder;
  PictureFormat format = PictureFormat::kPgm;
  Channel channel = Channel::kAuto;
  std::int64_t max_frames = 0;  ///< 0: until the source ends or a stop
  double max_seconds = 0;       ///< 0: likewise
  LiveTravel travel;
};

struct RecordSummary {
  std::int64_t frames = 0, whole = 0, incomplete = 0, lost = 0;
  double seconds = 0;
  CameraSettings settings;
  std::string first_missing;  ///< "3 lost, 17 incomplete ...": the first of them
};

/// Writes DIR/0000000.pgm ..., or the pages of one growing FILE.tif (with FILE.frames.csv and so on beside
/// it; travel by pages); frames.csv with a row for every frame, also one that is lost or incomplete (it has
/// no file, so that a scan keeps the others' places); travel.csv where the travel is known; record.yaml with
/// source, exposure and gain. Ends by the source, the limits or the stop; an Error where the disk is full or
/// the camera gone, and what was recorded stays usable.
RecordSummary record_frames(const RecordJob& job, const std::stop_token& stop,
                            const std::function<void(const RecordSummary&)>& progress);

/// Whether the scan's frames are there for good: each sensor's `lightstripe record` says that it has ended.
bool recording_is_over(const Scan& scan);

}  // namespace lightstripe
