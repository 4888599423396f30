// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scan_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "core/error.h"
#include "io/atomic_file.h"
#include "pipeline/run_record.h"
#include "reconstruct/cloud.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// Of everything that the files' bytes depend on; the pictures by name, size and time of their last change.
std::string fingerprint_of(const ScanRun& run) {
  const ReconstructJob& job = run.job;
  std::uint64_t hash = fnv1a(LIGHTSTRIPE_VERSION);
  hash = fnv1a(dump_yaml(job.extraction), hash);
  hash = fnv1a(read_file(job.scan_file), hash);
  hash = fnv1a(read_file(job.rig_file), hash);
  if (job.follow) return fmt::format("{:016x}", fnv1a("follow", hash));  // names and travel are still to come
  if (run.recording.table()) hash = fnv1a(read_file(*run.recording.table()), hash);
  hash = fnv1a(fmt::format("{}:{} {} {}", run.first_frame, run.end_frame, job.cloud.extension().string(),
                           !job.profiles.empty()),
               hash);
  for (std::int64_t frame = run.first_frame; frame < run.end_frame; ++frame)
    for (std::size_t s = 0; s < job.rig.sensors.size(); ++s)
      hash = fnv1a(run.recording.picture_identity(frame, static_cast<int>(s)) + "/", hash);
  return fmt::format("{:016x}", hash);
}

/// What an earlier run has done; its ranges follow from the travel table.
ScanSummary earlier_part(const ScanRun& run, const ScanTally& tally) {
  ScanSummary summary{tally.counts, {}, {}, false};
  for (std::int64_t frame = run.first_frame; frame < tally.next_frame; ++frame) {
    if (!run.recording.recorded(frame)) continue;
    const auto position = run.recording.position(frame);
    if (!position) summary.without_position.add(frame);
    if (position && position->interpolated) summary.interpolated.add(frame);
  }
  return summary;
}

}  // namespace

ScanRun open_run(const ReconstructJob& job) {
  Recording recording(job.scan, job.scan_file.string(), job.rig);
  const std::int64_t first = recording.first_frame(), end = recording.end_frame();
  const std::int64_t from = job.first_frame.value_or(first), to = job.end_frame.value_or(end);
  if (from >= end || to <= first || to <= from)
    throw Error(fmt::format("frames {}:{}", from, to),
                fmt::format("the recording has frames {} to {} only", first, end - 1), "give another range");
  return {job, std::move(recording), std::max(from, first), std::min(to, end)};
}

/// Text has all its digits: only binary clouds are written about an origin.
Eigen::Vector3d origin_of(const ScanRun& run) {
  return cloud_format(run.job.cloud, run.job.cloud.string()) == CloudFormat::kXyz
             ? Eigen::Vector3d::Zero().eval()
             : run.recording.cloud_origin();
}

ScanOutputOptions output_options(const ScanRun& run) {
  const std::chrono::milliseconds checkpoint(static_cast<std::int64_t>(1000 * run.job.checkpoint_s));
  return {run.job.cloud,       run.job.profiles, run.first_frame, origin_of(run),
          fingerprint_of(run), run.job.resume,   checkpoint};
}

ScanInput scan_input(const ScanRun& run, const ScanOutput& output, const std::stop_token& stop) {
  const Recording& recording = run.recording;
  ScanInput input;
  input.first_frame = output.tally().next_frame;
  input.end_frame = run.end_frame;
  input.before = earlier_part(run, output.tally());
  input.strict = run.job.strict;
  input.stop = stop;
  input.read = [&](std::int64_t frame, int sensor) { return recording.look(frame, sensor); };
  input.position = [&](std::int64_t frame) { return recording.position(frame); };
  input.recorded = [&](std::int64_t frame) { return recording.recorded(frame); };
  input.encode = [&](ScannedFrame& frame) { output.encode(frame); };
  return input;
}

void refuse_vanished_frames(const ScanRun& run) {
  if (!run.job.strict) return;
  const Recording& recording = run.recording;
  const std::string table = recording.table() ? recording.table()->string() : run.job.scan_file.string();
  if (!recording.without_picture().empty())
    throw Error(table, "knows frames that have no picture: " + recording.without_picture().text(),
                "wait for the recording's end, or take these rows out");
  if (!recording.losses().empty())
    throw Error(run.job.scan_file.string(), recording.losses().front(),
                "complete the recording, or scan what there is without --strict");
  FrameRanges lost;
  for (std::int64_t frame = run.first_frame; frame < run.end_frame; ++frame)
    if (recording.recorded(frame) && !recording.position(frame)) lost.add(frame);
  if (!lost.empty())
    throw Error(table, "says no position of the frames " + lost.text(),
                "complete it, or leave these pictures out");
}

void tell_earlier_points(const fs::path& cloud, const Eigen::Vector3d& origin, std::int64_t num_points,
                         const std::function<void(const Profile&)>& tell) {
  const CloudFormat format = cloud_format(cloud, cloud.string());
  if (format == CloudFormat::kXyz)
    throw Error(cloud.string(), "a .xyz file cannot be gone on with where a picture is drawn",
                "leave --preview out");
  std::ifstream file(cloud, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(cloud_header(format, 0, origin).size()));
  Profile one;
  one.points.resize(1);
  CloudPoint point;
  for (std::int64_t i = 0; i < num_points && file.read(reinterpret_cast<char*>(&point), sizeof(point)); ++i) {
    one.points[0].position = origin + Eigen::Vector3d(point.x, point.y, point.z);
    tell(one);
  }
}

int brightest_level(const ScanRun& run) {
  const Recording& recording = run.recording;
  constexpr int kPictures = 5;
  int looked_at = 0, brightest = 0;
  for (std::int64_t frame = run.first_frame; frame < run.end_frame; ++frame)
    for (int sensor = 0; sensor < static_cast<int>(run.job.rig.sensors.size()); ++sensor) {
      if (looked_at == kPictures) return brightest;
      if (recording.picture_name(frame, sensor).empty()) continue;
      try {
        const auto picture = recording.read(frame, sensor);
        ++looked_at;
        if (const auto* image = picture ? std::get_if<Image8>(&*picture) : nullptr; image != nullptr)
          brightest = std::max<int>(brightest, *std::max_element(image->pixels.begin(), image->pixels.end()));
        else
          return 255;  // of 16 bits nobody knows which are used
      } catch (const Error&) {
        continue;  // was told when its turn came
      }
    }
  return brightest;
}

}  // namespace lightstripe
