// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/reconstruct_job.h"

#include <chrono>

#include "io/output_guard.h"
#include "io/rig_file.h"
#include "pipeline/camera_recorders.h"
#include "pipeline/follow_recording.h"
#include "pipeline/outside_range.h"
#include "pipeline/reconstruct_refusals.h"
#include "pipeline/scan_record.h"
#include "pipeline/scan_run.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

void guard(const ReconstructJob& job) {
  std::vector<fs::path> tables = tables_of(job.scan), outputs = job.other_outputs, partial;
  tables.insert(tables.end(), {job.scan_file, job.rig_file});
  for (const fs::path& output : {job.cloud, job.profiles}) {
    if (output.empty()) continue;
    outputs.push_back(output);
    outputs.push_back(output.string() + ".run.yaml");
    partial.push_back(ResumableFile::partial_of(output));
  }
  // A night's task starts again and again: it neither lists nor looks up all pictures where it need not.
  if (any_exists(outputs)) guard_marked_outputs(pictures_of(job.scan), outputs);
  // What a killed run left holds points and no picture.
  outputs.insert(outputs.end(), partial.begin(), partial.end());
  guard_outputs(tables, outputs);
}

/// The scan itself.
void scan(const ScanRun& run, ScanOutput& output, const ProgressCallback& progress,
          const std::stop_token& stop, LineWidths& widths, ReconstructResult& result) {
  const ReconstructJob& job = run.job;
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t frames_before = output.tally().counts.frames;
  const ScanInput input = scan_input(run, output, stop);
  StepCounter steps("reconstructing", "frames", input.end_frame - input.first_frame, progress);
  result.summary = scan_profiles(input, job.rig, job.extraction, thread_count(job.threads),
                                 [&](const ScannedFrame& frame) {
                                   output.append(frame);
                                   for (const LineWidth& line : frame.lines) widths.add(line);
                                   if (job.on_profile) job.on_profile(frame.profile);
                                   steps.step();
                                 });
  result.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.frames_now += result.summary.frames - frames_before;
}

/// The scan's lines, with the channel that they were looked for in.
std::vector<SensorLines> lines_of(const ScanRun& run, const LineWidths& widths) {
  std::vector<SensorLines> lines;
  for (std::size_t s = 0; s < run.job.rig.sensors.size(); ++s)
    lines.push_back(
        widths.describe(s, run.job.rig.sensors[s].name, run.recording.channel(static_cast<int>(s))));
  return lines;
}

/// Result, messages and final names, once all frames are done.
void finish(const ScanRun& run, ScanOutput& output, ReconstructResult& result) {
  result.first_frame = run.first_frame;
  result.end_frame = result.summary.stopped ? output.tally().next_frame : run.end_frame;
  result.skipped = output.tally().skipped;
  result.duplicate_pictures = run.recording.duplicate_pictures();
  result.warnings = run.recording.warnings();
  result.outside_range = outside_range_texts(result.summary.outside, run.job.rig);
  result.without_picture = run.recording.without_picture();
  result.origin = origin_of(run);
  refuse_unusable_pictures(run.job, result);
  if (result.summary.points == 0) result.brightest = brightest_level(run);
  close_output(run, output, result);
  result.not_usable = why_not_usable(result);
}

ReconstructResult reconstruct_following(ReconstructJob job, const ProgressCallback& progress,
                                        const std::stop_token& stop) {
  CameraRecorders recorders(job);
  std::stop_source over;
  const auto end_it = [&] { over.request_stop(); };
  const std::stop_callback by_user(stop, end_it), by_failure(recorders.failed(), end_it);
  ReconstructResult result;
  std::optional<ScanOutput> output;
  LineWidths widths(job.rig.sensors.size());
  const auto scan_so_far = [&](const ScanRun& so_far, ScanOutput& into) {
    scan(so_far, into, progress, {}, widths, result);
  };
  const ScanRun run = scan_what_comes(job, scan_so_far, over.get_token(), output);
  recorders.end();
  result.lines = lines_of(run, widths);
  finish(run, *output, result);
  return result;
}

}  // namespace

ReconstructJob read_reconstruct_job(const fs::path& scan_file, const fs::path& rig_file) {
  ReconstructJob job;
  job.scan_file = scan_file;
  job.scan = read_scan(scan_file);
  job.rig_file = rig_file.empty() ? job.scan.folder / job.scan.rig : rig_file;
  job.rig = read_rig(job.rig_file);
  read_subtree(job.scan.extraction, job.extraction);
  return job;
}

std::pair<std::int64_t, std::int64_t> frames_to_reconstruct(const ReconstructJob& job) {
  const ScanRun run = open_run(job);
  return {run.first_frame, run.end_frame};
}

ReconstructResult reconstruct(const ReconstructJob& job, const ProgressCallback& progress,
                              const std::stop_token& stop) {
  const JobThreads threads(job.threads);
  refuse_camera_without_follow(job);
  guard(job);
  if (job.follow) return reconstruct_following(job, progress, stop);
  const ScanRun run = open_run(job);
  refuse_vanished_frames(run);
  ScanOutput output(output_options(run));
  const std::int64_t points_before = output.tally().counts.points;
  if (job.on_profile && points_before > 0)
    tell_earlier_points(output.was_complete() ? job.cloud : output.partial_cloud(), origin_of(run),
                        points_before, job.on_profile);
  ReconstructResult result;
  LineWidths widths(job.rig.sensors.size());
  scan(run, output, progress, stop, widths, result);
  result.lines = lines_of(run, widths);
  finish(run, output, result);
  return result;
}

}  // namespace lightstripe
