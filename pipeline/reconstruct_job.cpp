// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/reconstruct_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <thread>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/output_guard.h"
#include "io/rig_file.h"
#include "pipeline/camera_recorders.h"
#include "pipeline/outside_range.h"
#include "pipeline/reconstruct_refusals.h"
#include "pipeline/record_frames.h"
#include "pipeline/recording.h"
#include "pipeline/run_record.h"
#include "pipeline/scan_output.h"
#include "reconstruct/cloud.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// A job whose frames are known.
struct Run {
  const ReconstructJob& job;
  Recording recording;
  std::int64_t first_frame, end_frame;
};

Run open_run(const ReconstructJob& job) {
  Recording recording(job.scan, job.scan_file.string(), job.rig);
  const std::int64_t first = recording.first_frame(), end = recording.end_frame();
  const std::int64_t from = job.first_frame.value_or(first), to = job.end_frame.value_or(end);
  if (from >= end || to <= first || to <= from)
    throw Error(fmt::format("frames {}:{}", from, to),
                fmt::format("the recording has frames {} to {} only", first, end - 1), "give another range");
  return {job, std::move(recording), std::max(from, first), std::min(to, end)};
}

/// Of everything that the files' bytes depend on; the pictures by name, size and time of their last change.
std::string fingerprint_of(const Run& run) {
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

/// Text has all its digits: only binary clouds are written about an origin.
Eigen::Vector3d origin_of(const Run& run) {
  return cloud_format(run.job.cloud, run.job.cloud.string()) == CloudFormat::kXyz
             ? Eigen::Vector3d::Zero().eval()
             : run.recording.cloud_origin();
}

ScanOutputOptions output_options(const Run& run) {
  const std::chrono::milliseconds checkpoint(static_cast<std::int64_t>(1000 * run.job.checkpoint_s));
  return {run.job.cloud,       run.job.profiles, run.first_frame, origin_of(run),
          fingerprint_of(run), run.job.resume,   checkpoint};
}

/// Tells the points that an earlier run has left in its cloud.
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

/// What an earlier run has done; its ranges follow from the travel table.
ScanSummary earlier_part(const Run& run, const ScanTally& tally) {
  ScanSummary summary{tally.counts, {}, {}, false};
  for (std::int64_t frame = run.first_frame; frame < tally.next_frame; ++frame) {
    if (!run.recording.recorded(frame)) continue;
    const auto position = run.recording.position(frame);
    if (!position) summary.without_position.add(frame);
    if (position && position->interpolated) summary.interpolated.add(frame);
  }
  return summary;
}

ScanInput scan_input(const Run& run, const ScanOutput& output, const std::stop_token& stop) {
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

/// Largest grey level, of 8 bits, of the first pictures that can be read.
int brightest_level(const Run& run) {
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

/// The record's own part, in the order of the file.
struct RecordFields {
  std::string frames;
  bool complete = true;
  std::optional<std::string> without_position, without_picture, travel_interpolated;
  std::optional<std::vector<double>> origin;
  std::optional<std::vector<std::string>> warnings;
  std::optional<std::int64_t> pictures_skipped;
};
template <class V>
void visit_fields(V&& v, RecordFields& o) {
  v("frames", o.frames), v("complete", o.complete);
  v("without_position", o.without_position), v("without_picture", o.without_picture);
  v("travel_interpolated", o.travel_interpolated), v("origin", o.origin), v("warnings", o.warnings);
  v("pictures_skipped", o.pictures_skipped);
}

std::optional<std::string> ranges_text(const FrameRanges& ranges) {
  constexpr std::size_t kMostRuns = 1000;
  return ranges.empty() ? std::nullopt : std::optional(ranges.text(kMostRuns));
}

void write_record(const Run& run, const ReconstructResult& result, const fs::path& cloud) {
  RecordFields fields;
  fields.frames =
      fmt::format("{}:{}", result.first_frame, result.summary.stopped ? result.end_frame : run.end_frame);
  fields.complete = !result.summary.stopped;
  fields.without_position = ranges_text(result.summary.without_position);
  fields.without_picture = ranges_text(result.without_picture);
  fields.travel_interpolated = ranges_text(result.summary.interpolated);
  if (!result.origin.isZero()) fields.origin = {result.origin.x(), result.origin.y(), result.origin.z()};
  if (!result.warnings.empty()) fields.warnings = result.warnings;
  if (result.summary.pictures_skipped > 0) fields.pictures_skipped = result.summary.pictures_skipped;
  std::string text = dump_yaml(fields);
  if (result.summary.pictures_skipped > 0) text += "skipped:\n";
  for (const NamedSkip& skip : result.skipped)
    text += fmt::format("  - {{frame: {}, sensor: {}, reason: {}}}\n", skip.frame,
                        yaml_text(run.job.rig.sensors[static_cast<std::size_t>(skip.picture.sensor)].name),
                        yaml_text(skip.picture.reason));
  std::vector<fs::path> inputs{run.job.scan_file, run.job.rig_file};
  if (run.recording.table()) inputs.push_back(*run.recording.table());
  write_run_record(
      cloud, "reconstruct", inputs,
      text + lines_yaml(result.lines) + "extraction:\n" + indented(dump_yaml(run.job.extraction)));
}

/// Gives the finished or interrupted files their names and their records.
void close_output(const Run& run, ScanOutput& output, ReconstructResult& result) {
  const fs::path partial = output.partial_cloud();
  std::error_code ignored;
  if (result.summary.stopped) {
    output.keep();
    result.partial_cloud = partial;
    return write_record(run, result, partial);
  }
  if (result.summary.points == 0) return output.discard();
  output.commit();
  if (run.job.before_end) run.job.before_end();
  write_record(run, result, run.job.cloud);
  fs::remove(partial.string() + ".run.yaml", ignored);
  output.forget_journal();
}

void guard(const ReconstructJob& job) {
  std::vector<fs::path> inputs = files_of(job.scan), outputs = job.other_outputs;
  inputs.push_back(job.scan_file);
  inputs.push_back(job.rig_file);
  for (const fs::path& output : {job.cloud, job.profiles}) {
    if (output.empty()) continue;
    outputs.push_back(output);
    outputs.push_back(ResumableFile::partial_of(output));
  }
  outputs.push_back(job.cloud.string() + ".run.yaml");
  guard_outputs(inputs, outputs);
}

/// With `strict`: what would be left out is an error before anything is done.
void refuse_vanished_frames(const Run& run) {
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

/// The first frame that has to wait: not all sensors or the travel have it yet, or it is the newest, which
/// may still be written.
std::int64_t ready_end(const Run& run, bool newest_too) {
  std::int64_t end = run.end_frame;
  for (int sensor = 0; sensor < static_cast<int>(run.job.rig.sensors.size()); ++sensor) {
    std::int64_t last = run.end_frame - 1;
    while (last >= run.first_frame && run.recording.picture_name(last, sensor).empty()) --last;
    const bool has_pictures = last >= run.first_frame;
    if (has_pictures) end = std::min(end, newest_too ? last + 1 : last);
  }
  while (end > run.first_frame && !run.recording.position(end - 1)) --end;
  return end;
}

/// The recording as it is now; nothing where it cannot be read yet, and why.
std::optional<Run> run_so_far(const ReconstructJob& job, std::string& why_not) {
  try {
    return open_run(job);
  } catch (const Error& error) {
    why_not = error.what();
    return std::nullopt;
  }
}

/// The scan itself.
void scan(const Run& run, ScanOutput& output, const ProgressCallback& progress, const std::stop_token& stop,
          LineWidths& widths, ReconstructResult& result) {
  const ReconstructJob& job = run.job;
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t frames_before = output.tally().counts.frames;
  const ScanInput input = scan_input(run, output, stop);
  StepCounter steps("reconstructing", "frames", input.end_frame - input.first_frame, progress);
  result.summary = scan_profiles(input, job.rig, job.extraction, thread_count(job.threads),
                                 [&](const ScannedFrame& frame) {
                                   output.append(frame);
                                   widths.add(frame);
                                   if (job.on_profile) job.on_profile(frame.profile);
                                   steps.step();
                                 });
  result.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.frames_now += result.summary.frames - frames_before;
}

/// The scan's lines, with the channel that they were looked for in.
std::vector<SensorLines> lines_of(const Run& run, const LineWidths& widths) {
  std::vector<SensorLines> lines = widths.describe(run.job.rig);
  for (std::size_t s = 0; s < lines.size(); ++s)
    lines[s].channel = run.recording.channel(static_cast<int>(s));
  return lines;
}

/// Looks for new frames until the recording is over; returns the last look at it.
Run scan_what_comes(const ReconstructJob& job, std::optional<ScanOutput>& output,
                    const ProgressCallback& progress, const std::stop_token& stop, LineWidths& widths,
                    ReconstructResult& result) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPause = std::chrono::milliseconds(100);
  std::int64_t seen_end = 0;
  auto last_news = Clock::now();
  for (std::string why_not;;) {
    const auto begin = Clock::now();
    const bool stopped = stop.stop_requested(),
               recorded = recording_is_over(job.scan);  // before the look: nothing comes after it
    const bool idle = job.idle_s > 0 && begin - last_news > std::chrono::duration<double>(job.idle_s);
    const bool last_look = stopped || recorded || idle;
    auto run = run_so_far(job, why_not);
    if (last_look && !run)
      throw Error(job.scan_file.string(), "nothing that can be used was recorded (" + why_not + ")",
                  "look at the recording");
    const bool news = run && run->end_frame != seen_end;
    if (news) {
      seen_end = run->end_frame;
      last_news = Clock::now();
    }
    if (run) {
      if (!output) output.emplace(output_options(*run));
      if (!last_look) run->end_frame = ready_end(*run, !news);
      if (run->end_frame > output->tally().next_frame || last_look)
        scan(*run, *output, progress, {}, widths, result);
      if (last_look) return std::move(*run);
    }
    // Listing a long folder takes its time: most of the machine stays free for the pictures.
    std::this_thread::sleep_for(std::max<Clock::duration>(kPause, 2 * (Clock::now() - begin)));
  }
}

/// Result, messages and final names, once all frames are done.
void finish(const Run& run, ScanOutput& output, ReconstructResult& result) {
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
  const Run run = scan_what_comes(job, output, progress, over.get_token(), widths, result);
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
  const Run run = open_run(job);
  return {run.first_frame, run.end_frame};
}

ReconstructResult reconstruct(const ReconstructJob& job, const ProgressCallback& progress,
                              const std::stop_token& stop) {
  const JobThreads threads(job.threads);
  refuse_camera_without_follow(job);
  guard(job);
  if (job.follow) return reconstruct_following(job, progress, stop);
  const Run run = open_run(job);
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
