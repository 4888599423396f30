// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>

#include "core/error.h"
#include "core/robust.h"
#include "extraction/track/track_stripes.h"
#include "extraction/workspace.h"
#include "parallel/parallel.h"
#include "reconstruct/key_frames.h"

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

void check_size(const Picture& picture, const Sensor& sensor, std::int64_t frame) {
  const auto [width, height] = picture.visit([](const auto& i) { return std::pair(i.width, i.height); });
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

/// picture -> its stripes, of a frame and sensor.
using PictureUse = std::function<std::vector<Stripe>(const Picture&)>;
/// What a sensor shows in a frame; called from several threads.
using FrameExtractor = std::function<SensorStripes(std::int64_t frame, int sensor)>;

/// Reads a picture and uses it; nothing where the sensor has none.
SensorStripes read_and_use(const ScanInput& input, const Rig& rig, std::int64_t frame, int sensor,
                           const PictureUse& use) {
  SensorStripes found;
  std::optional<Picture> picture;
  try {
    picture = input.read(frame, sensor);
    if (picture) check_size(*picture, rig.sensors[static_cast<std::size_t>(sensor)], frame);
  } catch (const Error& error) {
    found.unreadable = std::current_exception();
    found.reason = error.what();
    return found;
  }
  if (!picture) return found;
  found.has_picture = true;
  found.stripes = use(*picture);
  return found;
}

ScannedFrame scan_frame(const PlacedFrame& placed, const ScanInput& input, const Rig& rig,
                        const FrameExtractor& extract) {
  ScannedFrame out;
  out.profile.frame = placed.frame;
  out.profile.travel = placed.position.travel;
  out.travel_interpolated = placed.position.interpolated;
  for (int sensor = 0; sensor < static_cast<int>(rig.sensors.size()); ++sensor) {
    const SensorStripes found = extract(placed.frame, sensor);
    if (found.unreadable && input.strict) std::rethrow_exception(found.unreadable);
    if (found.unreadable) out.skipped.push_back({sensor, found.reason});
    if (!found.has_picture) continue;
    ++out.pictures;
    for (const Stripe& stripe : found.stripes)
      if (!stripe.points.empty()) out.lines.push_back(line_width(sensor, stripe.points));
    triangulate_stripes(found.stripes, rig, sensor, placed.position, out.profile);
  }
  if (input.encode) input.encode(out);
  return out;
}

FrameOutcome outcome_of_frame(const PlacedFrame& placed, const ScanInput& input, const Rig& rig,
                              const FrameExtractor& extract) {
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

ScanSummary scan_frames(const ScanInput& input, const Rig& rig, const FrameExtractor& extract, int threads,
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

/// Memory of one thread.
struct Memory {
  ExtractionWorkspace workspace;
  ExtractionResult result;
};

/// Frames that are searched by their key frames.
class TrackedScan {
 public:
  TrackedScan(const ScanInput& input, const Rig& rig, const ExtractionOptions& options)
      : input_(input), rig_(rig), options_(options) {}

  SensorStripes operator()(std::int64_t frame, int sensor) {
    const std::int64_t key_frame = key_frame_of(frame);
    const bool recorded = !input_.recorded || input_.recorded(key_frame);
    const auto key = recorded ? keys_.get(key_frame, sensor, [&] { return key_of(key_frame, sensor); })
                              : std::make_shared<const KeyFrame>();
    if (key->failure) std::rethrow_exception(key->failure);
    if (frame == key_frame && recorded) return key->found;
    return read_and_use(input_, rig_, frame, sensor, [&](const Picture& picture) {
      return memories_.with([&](Memory& memory) {
        picture.visit([&](const auto& view) {
          track_stripes(view, options_, key->reference, memory.workspace, memory.result);
        });
        return memory.result.stripes;
      });
    });
  }

 private:
  KeyFrame key_of(std::int64_t frame, int sensor) {
    KeyFrame key;
    key.found = read_and_use(input_, rig_, frame, sensor, [&](const Picture& picture) {
      return memories_.with([&](Memory& memory) {
        picture.visit([&](const auto& view) {
          extract_stripes(view, options_, memory.workspace, memory.result);
          key.reference = reference_of(memory.workspace, memory.result, view);
        });
        return memory.result.stripes;
      });
    });
    return key;
  }

  const ScanInput& input_;
  const Rig& rig_;
  const ExtractionOptions& options_;
  WorkspacePool<Memory> memories_;
  KeyFrames keys_;
};

}  // namespace

LineWidth line_width(int sensor, std::span<const StripePoint> points) {
  std::vector<double> widths;
  widths.reserve(points.size());
  for (const StripePoint& p : points) widths.push_back(p.width);
  return {sensor, static_cast<int>(points.size()), upper_median(widths)};
}

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const StripeExtractor& extract, int threads,
                          const FrameSink& sink) {
  const auto stripes = [&](std::int64_t frame, int sensor) {
    return read_and_use(input, rig, frame, sensor,
                        [&](const Picture& picture) { return extract(picture.image()); });
  };
  return scan_frames(input, rig, stripes, threads, sink);
}

ScanSummary scan_profiles(const ScanInput& input, const Rig& rig, const ExtractionOptions& extraction,
                          int threads, const FrameSink& sink) {
  if (extraction.track) {
    TrackedScan tracked(input, rig, extraction);
    return scan_frames(
        input, rig, [&](std::int64_t frame, int sensor) { return tracked(frame, sensor); }, threads, sink);
  }
  WorkspacePool<Memory> memories;
  const auto extract = [&](const Picture& picture) {
    return memories.with([&](Memory& memory) {
      picture.visit(
          [&](const auto& view) { extract_stripes(view, extraction, memory.workspace, memory.result); });
      return memory.result.stripes;
    });
  };
  const auto stripes = [&](std::int64_t frame, int sensor) {
    return read_and_use(input, rig, frame, sensor, extract);
  };
  return scan_frames(input, rig, stripes, threads, sink);
}

}  // namespace lightstripe
