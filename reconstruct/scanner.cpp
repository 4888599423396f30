// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/scanner.h"

#include <fmt/format.h>

#include <atomic>
#include <exception>

#include "core/error.h"
#include "extraction/workspace.h"
#include "parallel/parallel.h"

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

/// A slot of the pipeline: where a frame lies from its issue until it has been handed on.
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

void count(const ScannedFrame& frame, ScanCounts& counts) {
  ++counts.frames;
  if (frame.profile.points.empty()) ++counts.frames_without_points;
  counts.points += static_cast<std::int64_t>(frame.profile.points.size());
  counts.rays_missed += frame.profile.num_missed;
  counts.pictures += frame.pictures;
  counts.pictures_skipped += static_cast<std::int64_t>(frame.skipped.size());
}

/// Counts a frame and hands it on; returns what went wrong with it, if anything.
std::exception_ptr hand_on(FrameOutcome& outcome, const FrameSink& sink, ScanSummary& summary) {
  if (outcome.error) return outcome.error;
  ScannedFrame& scanned = outcome.scanned;
  count(scanned, summary);
  scanned.counts = summary;
  for (const OutsideRange& outside : scanned.profile.outside) add_outside_range(outside, summary.outside);
  try {
    sink(scanned);
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const StripeExtractor& extract, int threads,
                          const FrameSink& sink) {
  ScanSummary summary = input.before;
  std::int64_t next = input.first_frame;
  std::atomic<bool> failed = false;
  std::exception_ptr error;
  std::vector<FrameInFlight> in_flight;
  PipelineSteps steps;
  steps.issue = [&](std::size_t slot) {
    const auto placed = failed ? std::nullopt : next_placed_frame(input, next, summary);
    if (placed) in_flight[slot] = {*placed, {}};
    return placed.has_value();
  };
  steps.process = [&](std::size_t slot) {
    FrameInFlight& frame = in_flight[slot];
    if (!failed) frame.outcome = outcome_of_frame(frame.placed, input, rig, extract);
  };
  steps.collect = [&](std::size_t slot) {
    if (failed) return;
    error = hand_on(in_flight[slot].outcome, sink, summary);
    failed = error != nullptr;
  };
  parallel_pipeline(
      threads, [&](std::size_t slots) { in_flight.resize(slots); }, steps);
  if (error) std::rethrow_exception(error);
  return summary;
}

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const ExtractionOptions& extraction,
                          int threads, const FrameSink& sink) {
  struct Memory {
    ExtractionWorkspace workspace;
    ExtractionResult result;
  };
  WorkspacePool<Memory> memories;
  const auto extract = [&](const GreyImage& image) {
    return memories.with([&](Memory& memory) {
      std::visit(
          [&](const auto& pixels) {
            extract_stripes(pixels.view(), extraction, memory.workspace, memory.result);
          },
          image);
      return memory.result.stripes;
    });
  };
  return scan_profiles(input, rig, StripeExtractor(extract), threads, sink);
}

}  // namespace lightstripe
