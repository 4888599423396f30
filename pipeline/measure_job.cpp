// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measure_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/counted.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/output_guard.h"
#include "io/yaml_binding.h"
#include "measure/measure_track.h"
#include "measure/profile_formats.h"
#include "measure/section_bends.h"
#include "pipeline/conicity_table.h"
#include "pipeline/measurement_table.h"
#include "pipeline/measurement_workbook.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// A wheel's diameter errs by the distance from the axis.
void take_axis_sigma(const RigOfSections& rig, const CalibrationErrors& errors, MeasureInput& input,
                     std::vector<std::string>& warnings) {
  input.wheel.axis_sigma_mm = errors.axis_sigma_mm;
  const bool has_diameter = input.wheel.radial || input.wheel.radius_offset_mm;
  if (input.kind == ObjectKind::kWheel && has_diameter && !rig.file.empty() && !errors.axis_sigma_mm)
    warnings.push_back(rig.file.string() + " says no error of its axis: the diameter gets none");
}

std::string effective_options(const MeasureJob& job, const CalibrationErrors& errors) {
  std::string text = calibration_yaml(errors);
  text += fmt::format("kind: {}\nregistration:\n{}", kind_name(job.kind),
                      indented(dump_yaml(job.options.registration)));
  text += job.kind == ObjectKind::kRail ? "rail:\n" + indented(dump_yaml(job.options.rail))
                                        : "wheel:\n" + indented(dump_yaml(job.options.wheel));
  return text + "limits:\n" + indented(dump_yaml(job.limits));
}

void write_section(const fs::path& path, const RecordedProfile& profile, bool simpack) {
  std::ostringstream text;
  simpack ? write_simpack(text, profile) : write_miniprof(text, profile);
  write_file(path, text.str());
}

/// Each section that was registered, on its reference, as a railway file.
void export_sections(const MeasureJob& job, const MeasureResult& result) {
  const bool simpack = job.export_format == SectionFormat::kSimpack, rail = job.kind == ObjectKind::kRail;
  const char* const extension = simpack ? (rail ? "prr" : "prw") : rail ? "ban" : "whl";
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const MeasuredFrame& row = result.rows[i];
    if (!row.registration.usable()) continue;
    RecordedProfile profile;
    profile.kind = job.kind;
    for (const ProfilePoint& p : result.input.profiles[i].points)
      profile.points.push_back(row.registration.reference_from_section * Eigen::Vector2d(p.u, p.v));
    profile.header["Frame"] = std::to_string(row.frame);
    write_section(job.export_folder / fmt::format("section_{:06}.{}", row.frame, extension), profile,
                  simpack);
  }
}

void warn_of_likeness(const IdentifiedRail& found, std::vector<std::string>& warnings) {
  if (found.also.empty()) return;
  warnings.push_back(
      fmt::format("{} cannot be told from {}: they differ in the head only, which wears; name the right one "
                  "with --nominal",
                  found.name, fmt::join(found.also, ", ")));
}

/// Each name that the user requires has to be a column of the table.
void check_required(const MeasureJob& job) {
  std::vector<std::string> names = estimate_names(job.kind);
  const auto extras =
      job.reference.two_rails ? track_extra_names(!job.reference.wheelset.empty()) : extra_names(job.kind);
  names.insert(names.end(), extras.begin(), extras.end());
  for (const std::string& name : job.options.required)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error("--require", fmt::format("'{}' is no quantity of a {}", name, kind_name(job.kind)),
                  fmt::format("name one of {}", fmt::join(names, ", ")));
}

std::string why_not_usable(const MeasureJob& job, const MeasureResult& result) {
  if (result.num_known > 0) return "";
  return job.options.required.empty()
             ? fmt::format("nothing could be measured in any of {}", counted(result.rows.size(), "frame"))
             : fmt::format("none of {} is known in any of {}", fmt::join(job.options.required, ", "),
                           counted(result.rows.size(), "frame"));
}

void guard(const MeasureJob& job, const RigOfSections& rig) {
  std::vector<fs::path> inputs = job.other_inputs, outputs = job.other_outputs;
  inputs.insert(inputs.end(), {job.profiles, job.profiles.string() + ".run.yaml", rig.file,
                               job.reference.nominal, job.reference.baseline, job.reference.nominal_right,
                               job.reference.wheelset, job.reference.wheelset_right});
  if (!job.table.empty()) outputs.insert(outputs.end(), {job.table, job.table.string() + ".run.yaml"});
  outputs.push_back(job.conicity_table);
  guard_outputs(inputs, outputs);
  if (job.export_folder.empty()) return;
  for (const fs::path& input : inputs) {  // sections are named by their frames
    std::error_code error;
    if (!input.empty() &&
        fs::equivalent(input.parent_path().empty() ? "." : input.parent_path(), job.export_folder, error) &&
        input.filename().string().starts_with("section_"))
      throw Error(
          job.export_folder.string(),
          "holds " + input.string() + ", which is an input, and sections of that name would be written there",
          "name another folder");
  }
}

MeasureResult prepare(const MeasureJob& job, const RigOfSections& rig) {
  check_required(job);
  if (!job.conicity_table.empty() && job.reference.wheelset.empty())
    throw Error("--conicity", "needs a wheelset", "name its wheels with --wheelset, e.g. S1002");
  std::vector<std::string> warnings;
  MeasureInput input = read_measure_input(job.profiles.string(), job.kind);
  CalibrationErrors errors = calibration_errors(rig.file, job.profiles, input.profiles);
  take_axis_sigma(rig, errors, input, warnings);
  if (input.further_profiles > 0)
    warnings.push_back(fmt::format("{} holds {} profiles: the first one is measured", job.profiles.string(),
                                   input.further_profiles + 1));
  MeasureReferences references(job.reference, input, job.options, errors);
  if (references.identified()) warn_of_likeness(*references.identified(), warnings);
  MeasureResult result{std::move(input), std::move(references), {}};
  result.rig = rig;
  result.calibration = std::move(errors);
  result.warnings = std::move(warnings);
  result.extra_columns = result.references.extra_columns();
  result.rows.resize(result.input.profiles.size());
  return result;
}

/// Of a long scan only every few sections are measured under each of the calibration's errors, which take ten
/// times as long; those between take over what the errors do to the nearest, where that knows all they know.
void measure_rows(const MeasureJob& job, MeasureResult& result, StepCounter& steps,
                  const std::stop_token& stop) {
  constexpr std::size_t kMostWithErrors = 200;
  const std::vector<Profile>& profiles = result.input.profiles;
  const MeasureReferences& references = result.references;
  // Without errors to count there is nothing to take over: every section is measured once.
  const std::size_t block =
      result.calibration.counted() ? (profiles.size() + kMostWithErrors - 1) / kMostWithErrors : 1;
  parallel_for((profiles.size() + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = b * block, last = std::min(profiles.size(), first + block);
    const std::size_t middle = (first + last) / 2;
    if (stop.stop_requested()) return;
    const auto measure_plain = [&](std::size_t i) {
      return references.measure_plain(profiles[i], result.input, job.options);
    };
    const auto with_errors = [&](const MeasuredFrame& plain, std::size_t i) {
      return references.with_errors(plain, profiles[i], result.input, job.options);
    };
    const MeasuredFrame plain = measure_plain(middle);
    result.rows[middle] = with_errors(plain, middle);
    steps.step();
    for (std::size_t i = first; i < last; ++i) {
      if (i == middle || stop.stop_requested()) continue;
      MeasuredFrame row = measure_plain(i);
      result.rows[i] = borrow_bends(plain, result.rows[middle], row) ? std::move(row) : with_errors(row, i);
      steps.step();
    }
  });
}

void write_results(const MeasureJob& job, const MeasureResult& result) {
  if (!job.table.empty()) {
    if (job.table.extension() == ".xlsx")
      write_measurement_workbook(job.table, result.rows, job.kind, result.extra_columns, result.verdicts,
                                 job.limits, calibration_word(result.calibration));
    else
      write_file(job.table, measurement_table(result.rows, job.kind, result.extra_columns, result.verdicts,
                                              calibration_word(result.calibration)));
    std::vector<fs::path> inputs{job.profiles};
    if (!result.rig.file.empty()) inputs.push_back(result.rig.file);
    write_run_record(job.table, "measure", inputs, effective_options(job, result.calibration));
  }
  if (!job.conicity_table.empty()) write_file(job.conicity_table, track_conicity_table(result.rows));
  if (!job.export_folder.empty()) export_sections(job, result);
}

}  // namespace

MeasureResult measure(const MeasureJob& job, const ProgressCallback& progress, const std::stop_token& stop) {
  const JobThreads threads(job.threads);
  const RigOfSections rig = rig_of_sections(job.profiles, job.rig);
  guard(job, rig);
  MeasureResult result = prepare(job, rig);
  StepCounter steps("measuring", "frames", static_cast<std::int64_t>(result.rows.size()), progress);
  measure_rows(job, result, steps, stop);
  if (stop.stop_requested())
    throw Error(job.profiles.string(), "the run was stopped before all sections were measured",
                "run it again");
  if (job.kind == ObjectKind::kWheel) result.run_out = find_run_out(result.rows);
  for (const MeasuredFrame& row : result.rows) {
    result.verdicts.push_back(verdict_name(judge(row, job.limits)));
    result.num_ok += row.status == "ok" ? 1 : 0;
    result.num_known += any_known(row, job.options) ? 1 : 0;
  }
  write_results(job, result);
  result.not_usable = why_not_usable(job, result);
  return result;
}

}  // namespace lightstripe
