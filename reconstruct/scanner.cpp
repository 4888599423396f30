// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/scanner.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <exception>

#include "core/error.h"
#include "core/task_order.h"
#include "extraction/workspace.h"

namespace lightstripe {
namespace {

// Exceptions travel with their frame instead of through the pipeline: so the one that comes out is that of
// the first frame, not that of the fastest thread.
struct PlacedFrame {
  std::int64_t frame = 0;
  FramePosition position;
  std::exception_ptr error;
};

struct FrameOutcome {
  ScannedFrame scanned;
  std::exception_ptr error;
};

/// Where a frame lies from its issue until it has been handed on; there is one for each frame in flight, used
/// in turn. The pipeline passes its address only: the copies that oneTBB would make of the frame itself lie
/// outside our tasks, where TSan cannot see their order.
struct FrameInFlight {
  PlacedFrame placed;
  FrameOutcome outcome;
};

void check_size(const GreyImage& image, const Sensor& sensor, std::int64_t frame) {
  const auto [width, height] = std::visit([](const auto& i) { return std::pair(i.width, i.height); }, image);
  if (width == sensor.camera.width && height == sensor.camera.height) return;
  throw Error(fmt::format("{}, frame {}", sensor.name, frame),
              fmt::format("the picture has {} x {} px but the rig's camera {} x {} px", width, height,
                          sensor.camera.width, sensor.camera.height),
              "use the rig that was calibrated with this camera at this picture size");
}

/// The next frame with a known position, or none at the end.
std::optional<PlacedFrame> next_placed_frame(const ScanInput& input, std::int64_t& next,
                                             ScanSummary& summary) {
  for (; next < input.end_frame; ++next) {
    if (input.stop.stop_requested()) {
      summary.stopped = true;
      return std::nullopt;
    }
    if (input.recorded && !input.recorded(next)) continue;
    try {
      if (const auto position = input.position(next)) {
        if (position->interpolated) summary.interpolated.add(next);
        return PlacedFrame{next++, *position, nullptr};
      }
    } catch (...) {
      return PlacedFrame{next++, {}, std::current_exception()};
    }
    summary.without_position.add(next);
  }
  return std::nullopt;
}

/// The picture, or nothing where it was skipped or the sensor has none.
std::optional<GreyImage> usable_picture(const ScanInput& input, const Rig& rig, int sensor,
                                        ScannedFrame& out) {
  try {
    auto image = input.read(out.profile.frame, sensor);
    if (image) check_size(*image, rig.sensors[static_cast<std::size_t>(sensor)], out.profile.frame);
    return image;
  } catch (const Error& error) {
    if (input.strict) throw;
    out.skipped.push_back({sensor, error.what()});
    return std::nullopt;
  }
}

ScannedFrame scan_frame(const PlacedFrame& placed, const ScanInput& input, const Rig& rig,
                        const StripeExtractor& extract) {
  ScannedFrame out;
  out.profile.frame = placed.frame;
  out.profile.travel = placed.position.travel;
  out.travel_interpolated = placed.position.interpolated;
  for (int sensor = 0; sensor < static_cast<int>(rig.sensors.size()); ++sensor) {
    const auto image = usable_picture(input, rig, sensor, out);
    if (!image) continue;
    ++out.pictures;
    triangulate_stripes(extract(*image), rig, sensor, placed.position, out.profile);
  }
  if (input.encode) input.encode(out);
  return out;
}

FrameOutcome outcome_of_frame(const PlacedFrame& placed, const ScanInput& input, const Rig& rig,
                              const StripeExtractor& extract) {
  if (placed.error) return {{}, placed.error};
  try {
    return {scan_frame(placed, input, rig, extract), nullptr};
  } catch (...) {
    return {{}, std::current_exception()};
  }
}

/// Hands a frame on and counts it; returns what went wrong with it, if anything.
std::exception_ptr hand_on(const FrameOutcome& outcome, const FrameSink& sink, ScanSummary& summary) {
  if (outcome.error) return outcome.error;
  const ScannedFrame& scanned = outcome.scanned;
  try {
    sink(scanned);
  } catch (...) {
    return std::current_exception();
  }
  ++summary.frames;
  if (scanned.profile.points.empty()) ++summary.frames_without_points;
  summary.points += static_cast<std::int64_t>(scanned.profile.points.size());
  summary.rays_missed += scanned.profile.num_missed;
  summary.pictures += scanned.pictures;
  summary.pictures_skipped += static_cast<std::int64_t>(scanned.skipped.size());
  return nullptr;
}

}  // namespace

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const StripeExtractor& extract, int threads,
                          const FrameSink& sink) {
  LIGHTSTRIPE_CHECK(threads >= 0, "the number of threads must not be negative");
  ScanSummary summary;
  std::int64_t next = input.first_frame;
  std::atomic<bool> failed = false;
  std::exception_ptr error;
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : threads);
  std::vector<FrameInFlight> in_flight(2 * static_cast<std::size_t>(arena.max_concurrency()));
  std::size_t issued = 0;
  const auto issue = [&](tbb::flow_control& flow) -> FrameInFlight* {
    const auto placed = failed ? std::nullopt : next_placed_frame(input, next, summary);
    if (!placed) {
      flow.stop();
      return nullptr;
    }
    FrameInFlight& frame = in_flight[issued++ % in_flight.size()];  // handed on: frames end in order
    frame = {*placed, {}};
    return &frame;
  };
  const auto process = [&](FrameInFlight* frame) {
    if (!failed) frame->outcome = outcome_of_frame(frame->placed, input, rig, extract);
    return frame;
  };
  const auto collect = [&](FrameInFlight* frame) {
    if (failed) return;
    error = hand_on(frame->outcome, sink, summary);
    failed = error != nullptr;
  };
  arena.execute([&] {
    before_tasks();
    tbb::parallel_pipeline(
        in_flight.size(),
        tbb::make_filter<void, FrameInFlight*>(tbb::filter_mode::serial_in_order, Task(issue)) &
            tbb::make_filter<FrameInFlight*, FrameInFlight*>(tbb::filter_mode::parallel, Task(process)) &
            tbb::make_filter<FrameInFlight*, void>(tbb::filter_mode::serial_in_order, Task(collect)));
    after_tasks();
  });
  if (error) std::rethrow_exception(error);
  return summary;
}

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const ExtractionOptions& extraction,
                          int threads, const FrameSink& sink) {
  struct Memory {
    ExtractionWorkspace workspace;
    ExtractionResult result;
  };
  tbb::enumerable_thread_specific<Memory> memories;
  const auto extract = [&](const GreyImage& image) {
    Memory& memory = memories.local();
    std::visit(
        [&](const auto& pixels) {
          extract_stripes(pixels.view(), extraction, memory.workspace, memory.result);
        },
        image);
    return memory.result.stripes;
  };
  return scan_profiles(input, rig, StripeExtractor(extract), threads, sink);
}

}  // namespace lightstripe
