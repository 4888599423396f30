// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The run of `reconstruct`: everything but its messages.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>

#include "apps/interrupt.h"
#include "apps/progress.h"
#include "apps/reconstruct.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/number_text.h"
#include "io/rig_file.h"
#include "pipeline/recording.h"
#include "pipeline/run_record.h"
#include "pipeline/scan_output.h"
#include "reconstruct/cloud.h"
#include "report/preview.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// A scan with all that its bytes depend on.
struct Job {
  const ReconstructArguments& arguments;
  std::string output;
  Scan scan;
  fs::path rig_file;
  Rig rig;
  ExtractionOptions extraction;
  std::int64_t first_frame = 0, end_frame = 0;
};

Job read_job(const ReconstructArguments& arguments) {
  Job job{arguments, arguments.common.output.empty() ? "cloud.ply" : arguments.common.output, {}, {}, {}, {}};
  job.scan = read_scan(arguments.scan);
  job.rig_file = arguments.rig.empty() ? job.scan.folder / job.scan.rig : fs::path(arguments.rig);
  job.rig = read_rig(job.rig_file);
  read_subtree(job.scan.extraction, job.extraction);
  apply_overrides(job.extraction, arguments.extraction);
  return job;
}

/// "A:B", "A:", ":B".
std::pair<std::int64_t, std::int64_t> parse_frames(const std::string& text, std::int64_t first,
                                                   std::int64_t end) {
  if (text.empty()) return {first, end};
  const std::size_t colon = text.find(':');
  const auto number = [&](const std::string& part, std::int64_t otherwise) -> std::optional<std::int64_t> {
    return part.empty() ? otherwise : parse_integer(part);
  };
  const auto a = number(text.substr(0, colon), first);
  const auto b = colon == std::string::npos ? std::nullopt : number(text.substr(colon + 1), end);
  if (!a || !b || *a < 0 || *b <= *a)
    throw Error("--frames", "'" + text + "' is no range of frames", "write A:B for the frames A to B - 1");
  if (*a >= end || *b <= first)
    throw Error("--frames", fmt::format("the recording has frames {} to {} only", first, end - 1),
                "give another range");
  return {std::max(*a, first), std::min(*b, end)};
}

/// Of everything that the files' bytes depend on, the pictures' content excepted.
std::string fingerprint_of(const Job& job, const Recording& recording) {
  std::uint64_t hash = fnv1a(LIGHTSTRIPE_VERSION);
  hash = fnv1a(dump_yaml(job.extraction), hash);
  hash = fnv1a(read_file(job.arguments.scan), hash);
  hash = fnv1a(read_file(job.rig_file), hash);
  if (recording.table()) hash = fnv1a(read_file(*recording.table()), hash);
  hash = fnv1a(fmt::format("{}:{} {} {}", job.first_frame, job.end_frame,
                           fs::path(job.output).extension().string(), !job.arguments.profiles.empty()),
               hash);
  for (std::int64_t frame = job.first_frame; frame < job.end_frame; ++frame)
    for (std::size_t s = 0; s < job.rig.sensors.size(); ++s)
      hash = fnv1a(recording.picture_name(frame, static_cast<int>(s)) + "/", hash);
  return fmt::format("{:016x}", hash);
}

/// What an earlier run has left behind, back into the picture of the cloud.
void preview_earlier_points(const fs::path& cloud, std::int64_t num_points, CloudPreview& preview) {
  const CloudFormat format = cloud_format(cloud, cloud.string());
  if (format == CloudFormat::kXyz)
    throw Error(cloud.string(), "a .xyz file cannot be gone on with where a picture is drawn",
                "leave --preview out");
  std::ifstream file(cloud, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(cloud_header(format, 0).size()));
  Profile one;
  one.points.resize(1);
  CloudPoint point;
  for (std::int64_t i = 0; i < num_points && file.read(reinterpret_cast<char*>(&point), sizeof(point)); ++i) {
    one.points[0].position = {point.x, point.y, point.z};
    preview.add(one);
  }
}

/// The counts of the part that was done before, and the ranges of the whole.
void add_earlier_part(const Recording& recording, std::int64_t first, const ScanOutput& output,
                      ScanSummary& summary) {
  FrameRanges without_position, interpolated;
  for (std::int64_t frame = first; frame < output.tally().next_frame; ++frame) {
    if (!recording.recorded(frame)) continue;
    const auto position = recording.position(frame);
    if (!position) without_position.add(frame);
    if (position && position->interpolated) interpolated.add(frame);
  }
  const bool stopped = summary.stopped;
  summary = output.tally().summary;
  summary.stopped = stopped;
  summary.without_position = without_position;
  summary.interpolated = interpolated;
}

ScanInput scan_input(const Job& job, const Recording& recording, const ScanOutput& output,
                     std::stop_token stop) {
  ScanInput input;
  input.first_frame = output.tally().next_frame;
  input.end_frame = job.end_frame;
  input.strict = job.arguments.strict;
  input.stop = std::move(stop);
  input.read = [&](std::int64_t frame, int sensor) { return recording.read(frame, sensor); };
  input.position = [&](std::int64_t frame) { return recording.position(frame); };
  input.recorded = [&](std::int64_t frame) { return recording.recorded(frame); };
  input.encode = [&](ScannedFrame& frame) { output.encode(frame); };
  return input;
}

/// Largest grey level, of 8 bits, of the first pictures that can be read.
int brightest_level(const Job& job, const Recording& recording) {
  constexpr int kPictures = 5;
  int looked_at = 0, brightest = 0;
  for (std::int64_t frame = job.first_frame; frame < job.end_frame; ++frame)
    for (int sensor = 0; sensor < static_cast<int>(job.rig.sensors.size()); ++sensor) {
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

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out.push_back('\\');
    out.push_back(c);
  }
  return out + '"';
}

void write_record(const Job& job, const Recording& recording, const ReconstructOutcome& outcome,
                  const std::string& cloud) {
  std::string text =
      fmt::format("frames: \"{}:{}\"\ncomplete: {}\n", outcome.first_frame,
                  outcome.summary.stopped ? outcome.end_frame : job.end_frame, !outcome.summary.stopped);
  if (!outcome.summary.without_position.empty())
    text += fmt::format("without_position: \"{}\"\n", outcome.summary.without_position.text(1000));
  if (!outcome.summary.interpolated.empty())
    text += fmt::format("travel_interpolated: \"{}\"\n", outcome.summary.interpolated.text(1000));
  if (outcome.summary.pictures_skipped > 0)
    text += fmt::format("pictures_skipped: {}\nskipped:\n", outcome.summary.pictures_skipped);
  for (const NamedSkip& skip : outcome.skipped)
    text += fmt::format("  - {{frame: {}, sensor: {}, reason: {}}}\n", skip.frame,
                        job.rig.sensors[static_cast<std::size_t>(skip.picture.sensor)].name,
                        in_quotes(skip.picture.reason));
  std::vector<fs::path> inputs{job.arguments.scan, job.rig_file};
  if (recording.table()) inputs.push_back(*recording.table());
  write_run_record(cloud, "reconstruct", inputs,
                   text + "extraction:\n" + indented(dump_yaml(job.extraction)));
}

/// Gives the finished or interrupted files their names and their records.
void close_output(const Job& job, const Recording& recording, const CloudPreview& preview, ScanOutput& output,
                  ReconstructOutcome& outcome) {
  const fs::path partial = output.partial_cloud();
  std::error_code ignored;
  if (outcome.summary.stopped) {
    output.keep();
    outcome.partial_cloud = partial.string();
    return write_record(job, recording, outcome, partial.string());
  }
  if (outcome.summary.points == 0) return output.discard();
  output.commit();
  if (!job.arguments.preview.empty()) {
    const RgbPicture picture = preview.draw();
    write_rgb_image(job.arguments.preview, picture.pixels, picture.width, picture.height);
  }
  write_record(job, recording, outcome, job.output);
  fs::remove(partial.string() + ".run.yaml", ignored);
  output.forget_journal();
}

}  // namespace

std::pair<std::int64_t, std::int64_t> frames_to_reconstruct(const ReconstructArguments& arguments) {
  const Job job = read_job(arguments);
  const Recording recording(job.scan, arguments.scan, job.rig);
  return parse_frames(arguments.frames, recording.first_frame(), recording.end_frame());
}

ReconstructOutcome reconstruct_scan(const ReconstructArguments& arguments) {
  const ThreadLimit limit(arguments.common);
  Job job = read_job(arguments);
  const Recording recording(job.scan, arguments.scan, job.rig);
  std::tie(job.first_frame, job.end_frame) =
      parse_frames(arguments.frames, recording.first_frame(), recording.end_frame());
  ScanOutput output({job.output, arguments.profiles, job.first_frame, fingerprint_of(job, recording),
                     arguments.resume,
                     std::chrono::milliseconds(static_cast<std::int64_t>(1000 * arguments.checkpoint_s))});
  CloudPreview preview;
  if (!arguments.preview.empty() && output.tally().summary.points > 0)
    preview_earlier_points(output.was_complete() ? fs::path(job.output) : output.partial_cloud(),
                           output.tally().summary.points, preview);
  ReconstructOutcome outcome;
  outcome.first_frame = job.first_frame;
  const InterruptWatch interrupt;
  const auto start = std::chrono::steady_clock::now();
  {
    const ScanInput input = scan_input(job, recording, output, interrupt.token());
    Progress progress("reconstructing", "frames", input.end_frame - input.first_frame,
                      arguments.common.quiet);
    outcome.summary = scan_profiles(input, job.rig, job.extraction, thread_count(arguments.common),
                                    [&](const ScannedFrame& frame) {
                                      output.append(frame);
                                      if (!arguments.preview.empty()) preview.add(frame.profile);
                                      progress.step();
                                    });
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.frames_now = outcome.summary.frames;
  add_earlier_part(recording, job.first_frame, output, outcome.summary);
  outcome.end_frame = outcome.summary.stopped ? output.tally().next_frame : job.end_frame;
  outcome.skipped = output.tally().skipped;
  outcome.duplicate_pictures = recording.duplicate_pictures();
  if (outcome.summary.pictures == 0 && !outcome.summary.stopped && !outcome.skipped.empty())
    throw Error(arguments.scan,
                fmt::format("none of its pictures can be used, the first because: {}",
                            outcome.skipped.front().picture.reason),
                "look at the pictures");
  if (arguments.strict && !outcome.duplicate_pictures.empty())
    throw Error(outcome.duplicate_pictures.front(), "another picture has the same number",
                "keep one of them");
  if (outcome.summary.points == 0) outcome.brightest = brightest_level(job, recording);
  close_output(job, recording, preview, output, outcome);
  return outcome;
}

}  // namespace lightstripe
