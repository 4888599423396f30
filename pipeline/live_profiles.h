// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A camera + rig -> one profile a frame while it measures, as lines of JSON for whatever comes behind.
#pragma once

#include <array>
#include <functional>
#include <stop_token>
#include <string>

#include "core/profile.h"
#include "core/rig.h"
#include "extraction/options.h"
#include "io/live_source.h"
#include "pipeline/record_frames.h"

namespace lightstripe {

struct LiveJob {
  std::string source;
  Rig rig;
  int sensor = 0;
  ExtractionOptions extraction = scan_extraction();
  Channel channel = Channel::kAuto;
  std::int64_t max_frames = 0;  ///< 0: until the source ends or a stop
  double max_seconds = 0;       ///< 0: likewise
  int max_waiting = 2;          ///< frames; what is older when its turn comes is left out as late
  LiveTravel travel;
};

/// How long frames took from complete to measured, counted in steps of 0.1 ms.
class LatencyCount {
 public:
  void add(double ms);
  /// Upper end of the step that holds this share (0 .. 1) of the frames; 0 without frames.
  double quantile(double share) const;

 private:
  static constexpr double kStepMs = 0.1;
  std::array<std::int64_t, 10001> steps_{};  ///< the last one: a second or more
  std::int64_t count_ = 0;
};

struct LiveSummary {
  std::int64_t frames = 0, whole = 0, incomplete = 0, lost = 0, late = 0, without_points = 0, points = 0;
  double seconds = 0;
  double sigma_mm = 0;  ///< median of the last profile
  LatencyCount latency;
};

struct LiveMeasurement {
  LiveFrame frame;  ///< without its picture
  Profile profile;
  int lines = 0;
  double sigma_mm = 0;    ///< median over the points
  double latency_ms = 0;  ///< from the frame's last byte to the finished profile
};

/// One line of JSON, without the line break: frame, status, time, [reason], [camera_ns, encoder, travel],
/// lines, points, missed, sigma_mm, latency_ms, and with `points` the profile's columns line, u, v, sigma
/// (mm, digits as in profiles.csv).
std::string json_line(const LiveMeasurement& measured, bool points);

/// Calls `sink` once a frame in the camera's order, also for those that are lost, incomplete or late. An
/// Error where a picture has not the size of the rig's camera, or the camera is gone.
LiveSummary live_profiles(const LiveJob& job, const std::stop_token& stop,
                          const std::function<void(const LiveMeasurement&, const LiveSummary&)>& sink);

}  // namespace lightstripe
