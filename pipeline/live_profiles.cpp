// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live_profiles.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/robust.h"
#include "extraction/extract_stripes.h"
#include "extraction/track/track_stripes.h"
#include "extraction/workspace.h"
#include "io/number_text.h"
#include "reconstruct/triangulate.h"

namespace lightstripe {
namespace {

struct Memory {
  ExtractionWorkspace workspace;
  ExtractionResult result;
  std::int64_t key_frame = -1;  ///< whose lines `reference` holds
  TrackReference reference;
};

/// As reconstruct does it, so that the points are those of the recorded run.
template <class T>
void extract(ImageView<T> image, const ExtractionOptions& options, std::int64_t frame, Memory& memory) {
  const std::int64_t key_frame = key_frame_of(frame);
  if (!options.track || frame == key_frame || key_frame != memory.key_frame) {
    extract_stripes(image, options, memory.workspace, memory.result);
    if (frame != key_frame) return;
    memory.key_frame = frame;
    memory.reference = reference_of(memory.workspace, memory.result, image);
    return;
  }
  track_stripes(image, options, memory.reference, memory.workspace, memory.result);
}

double median_sigma(const Profile& profile) {
  if (profile.points.empty()) return 0;
  std::vector<double> sigmas;
  sigmas.reserve(profile.points.size());
  for (const ProfilePoint& point : profile.points) sigmas.push_back(point.sigma_mm);
  return upper_median(sigmas);
}

void measure(const LiveJob& job, Memory& memory, LiveMeasurement& measured) {
  const Camera& camera = job.rig.sensors[static_cast<std::size_t>(job.sensor)].camera;
  std::visit(
      [&](const auto& image) {
        if (image.width != camera.width || image.height != camera.height)
          throw Error(job.source,
                      fmt::format("sends {} x {} px but the rig's camera has {} x {} px", image.width,
                                  image.height, camera.width, camera.height),
                      "set the camera as it was calibrated (aravis: region=X,Y,WIDTH,HEIGHT)");
        extract(image.view(), job.extraction, measured.frame.frame, memory);
      },
      measured.frame.image);
  measured.lines = static_cast<int>(memory.result.stripes.size());
  triangulate_stripes(memory.result.stripes, job.rig, job.sensor,
                      {measured.profile.travel, std::nullopt, false}, measured.profile);
  measured.sigma_mm = median_sigma(measured.profile);
}

void count(const LiveMeasurement& measured, LiveSummary& summary) {
  ++summary.frames;
  switch (measured.frame.status) {
    case FrameStatus::kLost:
      ++summary.lost;
      return;
    case FrameStatus::kIncomplete:
      ++summary.incomplete;
      return;
    case FrameStatus::kLate:
      ++summary.late;
      return;
    case FrameStatus::kWhole:
      break;
  }
  ++summary.whole;
  summary.points += static_cast<std::int64_t>(measured.profile.points.size());
  if (measured.profile.points.empty()) ++summary.without_points;
  summary.sigma_mm = measured.sigma_mm;
  summary.latency.add(measured.latency_ms);
}

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out.push_back('\\');
    out.push_back(static_cast<unsigned char>(c) < 0x20 ? ' ' : c);
  }
  return out + '"';
}

template <class Value>
void append_column(std::string& out, std::string_view name, const Profile& profile,
                   const Value& append_value) {
  out += fmt::format(",\"{}\":[", name);
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    if (i > 0) out.push_back(',');
    append_value(profile.points[i]);
  }
  out.push_back(']');
}

void append_points(std::string& out, const Profile& profile) {
  append_column(out, "line", profile, [&](const ProfilePoint& p) { append_integer(out, p.line); });
  append_column(out, "u", profile, [&](const ProfilePoint& p) { append_decimals(out, p.u, 5); });
  append_column(out, "v", profile, [&](const ProfilePoint& p) { append_decimals(out, p.v, 5); });
  append_column(out, "sigma", profile, [&](const ProfilePoint& p) { append_decimals(out, p.sigma_mm, 6); });
}

}  // namespace

void LatencyCount::add(double ms) {
  const double step = std::clamp(ms / kStepMs, 0.0, static_cast<double>(steps_.size() - 1));
  ++steps_[static_cast<std::size_t>(step)];
  ++count_;
}

double LatencyCount::quantile(double share) const {
  std::int64_t seen = 0;
  for (std::size_t i = 0; i < steps_.size() && count_ > 0; ++i) {
    seen += steps_[i];
    if (static_cast<double>(seen) >= share * static_cast<double>(count_))
      return static_cast<double>(i + 1) * kStepMs;
  }
  return 0;
}

std::string json_line(const LiveMeasurement& measured, bool points) {
  const LiveFrame& frame = measured.frame;
  const auto ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(frame.arrived.time_since_epoch()).count();
  std::string out =
      fmt::format("{{\"frame\":{},\"status\":\"{}\",\"time\":\"{:%FT%T}.{:03}Z\"", frame.frame,
                  name_of(frame.status), fmt::gmtime(static_cast<std::time_t>(ms / 1000)), ms % 1000);
  if (!frame.reason.empty()) out += ",\"reason\":" + json_text(frame.reason);
  if (frame.camera_ns != 0) out += fmt::format(",\"camera_ns\":{}", frame.camera_ns);
  if (frame.encoder) out += ",\"encoder\":" + shortest_text(*frame.encoder);
  if (frame.status != FrameStatus::kWhole) return out + "}";
  out += ",\"travel\":";
  append_decimals(out, measured.profile.travel, 6);
  out += fmt::format(",\"lines\":{},\"points\":{},\"missed\":{},\"sigma_mm\":", measured.lines,
                     measured.profile.points.size(), measured.profile.num_missed);
  append_decimals(out, measured.sigma_mm, 6);
  out += ",\"latency_ms\":";
  append_decimals(out, measured.latency_ms, 3);
  if (points) append_points(out, measured.profile);
  return out + "}";
}

LiveSummary live_profiles(const LiveJob& job, const std::stop_token& stop,
                          const std::function<void(const LiveMeasurement&, const LiveSummary&)>& sink) {
  LIGHTSTRIPE_CHECK(job.sensor >= 0 && job.sensor < static_cast<int>(job.rig.sensors.size()),
                    "a sensor of the rig");
  const auto source = open_live(job.source, {job.channel, job.max_waiting});
  TravelOfFrames travel_of(job.travel);
  Memory memory;
  LiveSummary summary;
  const auto start = std::chrono::steady_clock::now();
  while (job.max_frames == 0 || summary.frames < job.max_frames) {
    summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (job.max_seconds > 0 && summary.seconds >= job.max_seconds) break;
    auto frame = source->next(stop);
    if (!frame) break;
    LiveMeasurement measured;
    measured.profile.frame = frame->frame;
    measured.profile.travel = travel_of.at(*frame).value_or(0);
    measured.frame = std::move(*frame);
    if (measured.frame.status == FrameStatus::kWhole) measure(job, memory, measured);
    measured.frame.image = {};
    measured.latency_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - measured.frame.complete)
            .count();
    count(measured, summary);
    sink(measured, summary);
  }
  return summary;
}

}  // namespace lightstripe
