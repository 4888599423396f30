// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/measure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "core/error.h"
#include "core/task_order.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/rig_file.h"
#include "measure/measure_track.h"
#include "measure/profile_formats.h"
#include "pipeline/frame_links.h"
#include "pipeline/measure_input.h"
#include "pipeline/measure_references.h"
#include "pipeline/measurement_table.h"
#include "pipeline/run_record.h"
#include "report/measure_report.h"
#include "report/section_drawing.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

std::string output_of(const MeasureArguments& arguments) {
  return arguments.common.output.empty() ? "measurements.csv" : arguments.common.output;
}

/// The names of --require, each looked up among the table's columns.
std::vector<std::string> required_of(const MeasureArguments& arguments) {
  std::vector<std::string> names = estimate_names(arguments.kind);
  const auto extras = arguments.two_rails ? track_extra_names() : extra_names(arguments.kind);
  names.insert(names.end(), extras.begin(), extras.end());
  for (const std::string& name : arguments.require)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error("--require", fmt::format("'{}' is no quantity of a {}", name, kind_name(arguments.kind)),
                  fmt::format("name one of {}", fmt::join(names, ", ")));
  return arguments.require;
}

MeasureOptions options_of(const MeasureArguments& arguments) {
  MeasureOptions options;
  apply_overrides(options.rail, arguments.rail);
  apply_overrides(options.wheel, arguments.wheel);
  apply_overrides(options.registration, arguments.registration);
  options.required = required_of(arguments);
  if (arguments.max_overlap_gap_mm) options.max_overlap_gap_mm = *arguments.max_overlap_gap_mm;
  return options;
}

/// How well the rig knows the distance from its axis: the larger of the axis point's sigmas, nothing if the
/// rig says none.
std::optional<double> axis_sigma(const std::string& rig_file) {
  std::optional<double> largest;
  for (const auto& [name, sigma] : read_rig(rig_file).quality.sigma)
    if (name.find("axis_point") != std::string::npos) largest = std::max(largest.value_or(0), sigma);
  if (!largest) warn(rig_file + " says no error of its axis: the diameter gets none");
  return largest;
}

Limits limits_of(const MeasureArguments& arguments) {
  Limits limits;
  if (!arguments.limits.empty()) read_yaml(arguments.limits, limits);
  apply_overrides(limits, arguments.limit);
  return limits;
}

std::string effective_options(const MeasureArguments& arguments, const MeasureOptions& options,
                              const Limits& limits) {
  std::string text = fmt::format("kind: {}\nregistration:\n{}", kind_name(arguments.kind),
                                 indented(dump_yaml(options.registration)));
  text += arguments.kind == ObjectKind::kRail ? "rail:\n" + indented(dump_yaml(options.rail))
                                              : "wheel:\n" + indented(dump_yaml(options.wheel));
  return text + "limits:\n" + indented(dump_yaml(limits));
}

void write_section(const fs::path& path, const RecordedProfile& profile, bool simpack) {
  std::ostringstream text;
  simpack ? write_simpack(text, profile) : write_miniprof(text, profile);
  write_file(path, text.str());
}

/// Each section that was registered, on its reference, as a railway file.
void export_sections(const MeasureArguments& arguments, const MeasureInput& input,
                     const MeasureOutcome& outcome) {
  const bool simpack = arguments.export_format == "simpack", rail = arguments.kind == ObjectKind::kRail;
  const char* const extension = simpack ? (rail ? "prr" : "prw") : rail ? "ban" : "whl";
  for (std::size_t i = 0; i < outcome.rows.size(); ++i) {
    const MeasuredFrame& row = outcome.rows[i];
    if (!row.registration.usable()) continue;
    RecordedProfile profile;
    profile.kind = arguments.kind;
    for (const ProfilePoint& p : input.profiles[i].points)
      profile.points.push_back(row.registration.reference_from_section * Eigen::Vector2d(p.u, p.v));
    profile.header["Frame"] = std::to_string(row.frame);
    write_section(fs::path(arguments.export_folder) / fmt::format("section_{:06}.{}", row.frame, extension),
                  profile, simpack);
  }
}

void write_plots(const MeasureArguments& arguments, const MeasureInput& input, const MeasureOutcome& outcome,
                 const MeasureReferences& references) {
  if (!arguments.export_folder.empty()) export_sections(arguments, input, outcome);
  for (const std::int64_t frame : arguments.plot) {
    const auto row = std::find_if(outcome.rows.begin(), outcome.rows.end(),
                                  [&](const MeasuredFrame& r) { return r.frame == frame; });
    if (row == outcome.rows.end())
      throw Error(fmt::format("--plot {}", frame), "the sections have no such frame",
                  "give the number of a frame in the table");
    const auto& profile = input.profiles[static_cast<std::size_t>(row - outcome.rows.begin())];
    const RgbPicture picture =
        section_picture(draw_section(profile, row->registration, references.at(row->travel)), *row);
    const fs::path path = fs::path(output_of(arguments)).replace_extension() +=
        fmt::format("_{:06}.png", frame);
    write_rgb_image(path, picture.pixels, picture.width, picture.height);
    say(arguments.common, "frame " + std::to_string(frame) + " -> " + path.string());
  }
}

void say_run_out(const CommonOptions& common, const RunOut& run_out) {
  const auto line = [&](const char* what, const Estimate& estimate) {
    if (estimate.value)
      say(common, fmt::format("{} run-out {:.3f} mm, sigma {:.3f}", what, *estimate.value,
                              estimate.sigma.value_or(0)));
  };
  line("radial", run_out.radial);
  line("axial", run_out.axial);
}

void summarise(const MeasureArguments& arguments, const MeasureOutcome& outcome) {
  const CommonOptions& common = arguments.common;
  say(common, fmt::format("{:<18} {:>6} {:>10} {:>10} {:>10}", "", "frames", "lowest", "mean", "highest"));
  for (const std::string& name : estimate_names(arguments.kind)) {
    const Spread spread = spread_of(outcome.rows, name);
    if (spread.known == 0) continue;
    say(common, fmt::format("{:<18} {:>6} {:>10.3f} {:>10.3f} {:>10.3f}", name, spread.known, spread.low,
                            spread.mean, spread.high));
  }
  for (const char* const name : {"overlap_gap", "gauge"}) {
    const Spread spread = spread_of(outcome.rows, name);
    if (spread.known > 0)
      say(common, fmt::format("{:<18} {:>6} {:>10.3f} {:>10.3f} {:>10.3f}", name, spread.known, spread.low,
                              spread.mean, spread.high));
  }
  if (outcome.run_out) say_run_out(common, *outcome.run_out);
  const Spread diameter = spread_of(outcome.rows, "diameter");
  if (diameter.known > 0 && !arguments.rig.empty())
    say(common,
        "the diameter's sigma is twice that of the axis' place in the rig's calibration: a board seen over a "
        "few degrees fixes an "
        "axis half a metre away only to a millimetre; it is common to all frames");
  std::map<std::string, int> reasons;
  for (const MeasuredFrame& row : outcome.rows)
    if (row.status != "ok") ++reasons[row.status];
  for (const auto& [reason, count] : reasons)
    warn(fmt::format("{} of {} frames: {}", count, outcome.rows.size(), reason));
  say(common,
      fmt::format("{} of {} frames ok -> {}", outcome.num_ok, outcome.rows.size(), output_of(arguments)));
}

int run_measure(const MeasureArguments& arguments) {
  const MeasureOutcome outcome = measure_profiles(arguments);
  summarise(arguments, outcome);
  if (outcome.num_known == 0)
    return not_usable(arguments.require.empty()
                          ? fmt::format("nothing could be measured in any of {} frames", outcome.rows.size())
                          : fmt::format("none of {} is known in any of {} frames",
                                        fmt::join(arguments.require, ", "), outcome.rows.size()));
  if (outcome.num_ok == 0)
    warn(
        fmt::format("none of {} frames could be measured completely: what is not known is an empty cell "
                    "(--require names what you need)",
                    outcome.rows.size()));
  return kExitDone;
}

}  // namespace

MeasureOutcome measure_profiles(const MeasureArguments& arguments) {
  const ThreadLimit limit(arguments.common);
  const MeasureOptions options = options_of(arguments);
  const Limits limits = limits_of(arguments);
  MeasureInput input = read_measure_input(arguments.profiles, arguments.kind);
  if (!arguments.rig.empty() && arguments.kind == ObjectKind::kWheel)
    input.wheel.axis_sigma_mm = axis_sigma(arguments.rig);
  const MeasureReferences references(arguments, input, options);
  MeasureOutcome outcome;
  outcome.extra_columns = references.extra_columns();
  outcome.rows.resize(input.profiles.size());
  const auto measure_frame = [&](std::size_t i) {
    outcome.rows[i] = references.measure(input.profiles[i], input, options);
  };
  before_tasks();
  oneapi::tbb::parallel_for(std::size_t{0}, input.profiles.size(), Task(measure_frame));
  after_tasks();
  if (arguments.kind == ObjectKind::kWheel) outcome.run_out = find_run_out(outcome.rows);
  for (const MeasuredFrame& row : outcome.rows) {
    outcome.verdicts.push_back(verdict_name(judge(row, limits)));
    outcome.num_ok += row.status == "ok" ? 1 : 0;
    outcome.num_known += any_known(row, options) ? 1 : 0;
  }
  write_file(output_of(arguments),
             measurement_table(outcome.rows, arguments.kind, outcome.extra_columns, outcome.verdicts));
  write_plots(arguments, input, outcome, references);
  if (!arguments.report.empty())
    write_file(arguments.report, measure_report_html({arguments, input.profiles, outcome, references, limits,
                                                      options.max_overlap_gap_mm}));
  write_run_record(output_of(arguments), "measure", {arguments.profiles},
                   effective_options(arguments, options, limits));
  return outcome;
}

void add_measure_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("measure", "sections to wear and dimensions of rails and wheels");
  auto arguments = std::make_shared<MeasureArguments>();
  const std::map<std::string, ObjectKind> kinds{{"rail", ObjectKind::kRail}, {"wheel", ObjectKind::kWheel}};
  command
      ->add_option("profiles", arguments->profiles,
                   "sections: profiles.csv, or one of .ban .whl .mpt .prr .prw")
      ->required();
  command->add_option("--kind", arguments->kind, "rail or wheel")
      ->transform(CLI::CheckedTransformer(kinds))
      ->required();
  command->add_option(
      "--nominal", arguments->nominal,
      "the new rail or wheel: a name, an outline file, a recorded profile (baseline), or auto [60E1, S1002]");
  command->add_option(
      "--baseline", arguments->baseline,
      "an earlier measurement (profiles.csv, .ban, .whl ...) as reference; --nominal guides it");
  const std::map<std::string, bool> rails{{"one", false}, {"two", true}};
  command
      ->add_option("--rails", arguments->two_rails,
                   "one or two: sensors over both rails of a track; measures the gauge between them [one]")
      ->transform(CLI::CheckedTransformer(rails));
  command->add_option("--nominal-right", arguments->nominal_right,
                      "with --rails two: the new rail at -y [as --nominal]");
  command
      ->add_option("--require", arguments->require,
                   "what you need of each section, e.g. vertical_wear,side_wear: a row is ok where these are "
                   "known, exit code 3 where none of them is [all]")
      ->delimiter(',');
  command->add_option("--scan", arguments->scan, "scan file: the report links to its pictures");
  command->add_option("--limits", arguments->limits, "file of limits (YAML)");
  command->add_option("--report", arguments->report, "report to look at (HTML)");
  command->add_option("--plot", arguments->plot,
                      "draws the section of this frame (PNG beside the table); may be repeated");
  command->add_option("--export", arguments->export_folder,
                      "writes each registered section there (.ban, .whl or .prr, .prw)");
  command->add_option("--export-format", arguments->export_format, "miniprof or simpack [miniprof]")
      ->check(CLI::IsMember({"miniprof", "simpack"}));
  command->add_option("--rig", arguments->rig, "rig file, for the diameter's predicted error");
  add_common_options(*command, arguments->common, "table of measurements (default: measurements.csv)");
  add_field_options<RailOptions>(*command, "", arguments->rail);
  add_field_options<WheelOptions>(*command, "wheel.", arguments->wheel);
  add_field_options<RegistrationOptions>(*command, "registration.", arguments->registration);
  add_field_options<Limits>(*command, "limit.", arguments->limit);
  command->add_option("--max-overlap-gap-mm", arguments->max_overlap_gap_mm,
                      "between two sensors on the head: above, the calibration is in doubt [0.1]");
  command->callback([arguments, &run] { run = [arguments] { return run_measure(*arguments); }; });
}

}  // namespace lightstripe
