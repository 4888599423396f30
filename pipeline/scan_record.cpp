// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scan_record.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "io/yaml_binding.h"
#include "pipeline/rig_of_sections.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// The record's own part, in the order of the file.
struct ScanFields {
  std::string frames;
  bool complete = true;
  std::optional<std::string> without_position, without_picture, travel_interpolated;
  std::optional<std::vector<double>> origin;
  std::optional<std::vector<std::string>> warnings;
  std::optional<std::int64_t> pictures_skipped;
};
template <class V>
void visit_fields(V&& v, ScanFields& o) {
  v("frames", o.frames), v("complete", o.complete);
  v("without_position", o.without_position), v("without_picture", o.without_picture);
  v("travel_interpolated", o.travel_interpolated), v("origin", o.origin), v("warnings", o.warnings);
  v("pictures_skipped", o.pictures_skipped);
}

std::optional<std::string> ranges_text(const FrameRanges& ranges) {
  constexpr std::size_t kMostRuns = 1000;
  return ranges.empty() ? std::nullopt : std::optional(ranges.text(kMostRuns));
}

std::vector<fs::path> inputs_of(const ScanRun& run) {
  std::vector<fs::path> inputs{run.job.scan_file, run.job.rig_file};
  if (run.recording.table()) inputs.push_back(*run.recording.table());
  return inputs;
}

void write_record(const ScanRun& run, const ReconstructResult& result, const fs::path& cloud) {
  ScanFields fields;
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
  write_run_record(
      cloud, "reconstruct", inputs_of(run),
      text + lines_yaml(result.lines) + "extraction:\n" + indented(dump_yaml(run.job.extraction)));
}

/// Beside the sections: of which rig they are. A pipe has no place beside it.
void write_sections_record(const ScanRun& run, const fs::path& profiles) {
  std::error_code error;
  if (!fs::is_regular_file(profiles, error)) return;
  write_sections_record(profiles, "reconstruct", inputs_of(run), place_of_rig(run.job.rig_file, run.job.rig),
                        "the rig file was changed while the scan was reconstructed");
}

}  // namespace

void close_output(const ScanRun& run, ScanOutput& output, ReconstructResult& result) {
  const fs::path partial = output.partial_cloud(), profiles = run.job.profiles;
  const fs::path partial_profiles = profiles.empty() ? profiles : ResumableFile::partial_of(profiles);
  std::error_code ignored;
  if (result.summary.stopped) {
    output.keep();
    result.partial_cloud = partial;
    write_sections_record(run, partial_profiles);
    return write_record(run, result, partial);
  }
  if (result.summary.points == 0) return output.discard();
  output.commit();
  if (run.job.before_end) run.job.before_end();
  write_sections_record(run, profiles);
  write_record(run, result, run.job.cloud);
  for (const fs::path& half : {partial, partial_profiles})
    if (!half.empty()) fs::remove(half.string() + ".run.yaml", ignored);
  output.forget_journal();
}

}  // namespace lightstripe
