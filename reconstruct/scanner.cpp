// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/scanner.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <exception>

#include "core/error.h"

namespace lightstripe {
namespace {

// Exceptions travel with their frame instead of through the pipeline: oneTBB 2021.8 drops what is under way
// without destroying it, and so the one that comes out is that of the first frame, not that of the fastest
// thread.
struct PlacedFrame {
  std::int64_t frame = 0;
  FramePosition position;
  std::exception_ptr error;
};

struct FrameOutcome {
  Profile profile;
  std::exception_ptr error;
};

void check_size(const Image8& image, const Sensor& sensor, std::int64_t frame) {
  if (image.width == sensor.camera.width && image.height == sensor.camera.height) return;
  throw Error(fmt::format("{}, frame {}", sensor.name, frame),
              fmt::format("the picture has {} x {} px but the rig's camera {} x {} px", image.width,
                          image.height, sensor.camera.width, sensor.camera.height),
              "use the rig that was calibrated with this camera at this picture size");
}

/// The next frame with a known position, or none at the end.
std::optional<PlacedFrame> next_placed_frame(const ScanInput& input, std::int64_t& next,
                                             ScanSummary& summary) {
  for (; next < input.num_frames; ++next) {
    if (input.stop.stop_requested()) {
      summary.stopped = true;
      return std::nullopt;
    }
    try {
      if (const auto position = input.position(next)) return PlacedFrame{next++, *position, nullptr};
    } catch (...) {
      return PlacedFrame{next++, {}, std::current_exception()};
    }
    ++summary.frames_without_position;
  }
  return std::nullopt;
}

Profile profile_of_frame(const PlacedFrame& placed, const ScanInput& input, const Rig& rig,
                         const StripeExtractor& extract) {
  Profile profile;
  profile.frame = placed.frame;
  profile.travel = placed.position.travel;
  for (int sensor = 0; sensor < static_cast<int>(rig.sensors.size()); ++sensor) {
    const auto image = input.read(placed.frame, sensor);
    if (!image) continue;
    check_size(*image, rig.sensors[static_cast<std::size_t>(sensor)], placed.frame);
    triangulate_stripes(extract(*image), rig, sensor, placed.position, profile);
  }
  return profile;
}

FrameOutcome outcome_of_frame(const PlacedFrame& placed, const ScanInput& input, const Rig& rig,
                              const StripeExtractor& extract) {
  if (placed.error) return {{}, placed.error};
  try {
    return {profile_of_frame(placed, input, rig, extract), nullptr};
  } catch (...) {
    return {{}, std::current_exception()};
  }
}

/// Hands a profile on and counts it; returns what went wrong with this frame, if anything.
std::exception_ptr hand_on(const FrameOutcome& outcome, const std::function<void(const Profile&)>& sink,
                           ScanSummary& summary) {
  if (outcome.error) return outcome.error;
  try {
    sink(outcome.profile);
  } catch (...) {
    return std::current_exception();
  }
  ++summary.frames;
  if (outcome.profile.points.empty()) ++summary.frames_without_points;
  summary.points += static_cast<std::int64_t>(outcome.profile.points.size());
  summary.rays_missed += outcome.profile.num_missed;
  return nullptr;
}

}  // namespace

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const StripeExtractor& extract, int threads,
                          const std::function<void(const Profile&)>& sink) {
  LIGHTSTRIPE_CHECK(threads >= 0, "the number of threads must not be negative");
  ScanSummary summary;
  std::int64_t next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr error;
  const auto issue = [&](tbb::flow_control& flow) {
    auto placed = failed ? std::nullopt : next_placed_frame(input, next, summary);
    if (!placed) flow.stop();
    return placed.value_or(PlacedFrame{});
  };
  const auto process = [&](const PlacedFrame& placed) {
    return failed ? FrameOutcome{} : outcome_of_frame(placed, input, rig, extract);
  };
  const auto collect = [&](const FrameOutcome& outcome) {
    if (failed) return;
    error = hand_on(outcome, sink, summary);
    failed = error != nullptr;
  };
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : threads);
  const auto tokens = 2 * static_cast<std::size_t>(arena.max_concurrency());
  arena.execute([&] {
    tbb::parallel_pipeline(
        tokens, tbb::make_filter<void, PlacedFrame>(tbb::filter_mode::serial_in_order, issue) &
                    tbb::make_filter<PlacedFrame, FrameOutcome>(tbb::filter_mode::parallel, process) &
                    tbb::make_filter<FrameOutcome, void>(tbb::filter_mode::serial_in_order, collect));
  });
  if (error) std::rethrow_exception(error);
  return summary;
}

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const ExtractionOptions& extraction,
                          int threads, const std::function<void(const Profile&)>& sink) {
  const auto extract = [&](ImageView8 image) { return extract_stripes(image, extraction).stripes; };
  return scan_profiles(input, rig, StripeExtractor(extract), threads, sink);
}

}  // namespace lightstripe
