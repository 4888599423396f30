// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measure_job.h"

#include <fmt/format.h>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/progress.h"
#include "apps/table_style.h"
#include "core/counted.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/output_guard.h"
#include "pipeline/features_job.h"
#include "report/calibration_error_text.h"
#include "report/cloud_deviation.h"
#include "report/features_report.h"
#include "report/measure_report.h"
#include "report/measure_text.h"
#include "report/section_drawing.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct MeasureArguments {
  CommonOptions common;
  MeasureJob job;    ///< what needs no merging is parsed into it
  std::string kind;  ///< rail, wheel or features
  std::string features, limits_file, report, scan, view;
  TableStyle style = TableStyle::kPlain;
  std::vector<std::int64_t> plot;
  Overrides rail, wheel, registration, limit, conicity;
};

/// The picture of a frame's section, beside the table.
fs::path plot_file(const MeasureJob& job, std::int64_t frame) {
  return fs::path(job.table).replace_extension() += fmt::format("_{:06}.png", frame);
}

MeasureJob job_of(const MeasureArguments& arguments) {
  MeasureJob job = arguments.job;
  apply_overrides(job.options.rail, arguments.rail);
  apply_overrides(job.options.wheel, arguments.wheel);
  apply_overrides(job.options.registration, arguments.registration);
  apply_overrides(job.reference.conicity, arguments.conicity);
  if (!arguments.limits_file.empty()) read_yaml(arguments.limits_file, job.limits);
  apply_overrides(job.limits, arguments.limit);
  if (!arguments.common.output.empty()) job.table = arguments.common.output;
  job.threads = arguments.common.threads;
  job.other_inputs = {arguments.limits_file, arguments.scan};
  if (!arguments.scan.empty()) {
    const std::vector<fs::path> pictures = files_of(read_scan(arguments.scan));
    job.other_inputs.insert(job.other_inputs.end(), pictures.begin(), pictures.end());
  }
  job.other_outputs = {arguments.report, arguments.view};
  for (const std::int64_t frame : arguments.plot) job.other_outputs.push_back(plot_file(job, frame));
  return job;
}

void write_plots(const MeasureArguments& arguments, const MeasureJob& job, const MeasureResult& result) {
  for (const std::int64_t frame : arguments.plot) {
    const RgbPicture picture = plot_frame(result, frame);
    const fs::path path = plot_file(job, frame);
    write_rgb_image(path, picture.pixels, picture.width, picture.height);
    say(arguments.common, "frame " + std::to_string(frame) + " -> " + path.string());
  }
}

int run_measure(const MeasureArguments& arguments) {
  const MeasureJob job = job_of(arguments);
  const MeasureResult result = measure(job, progress_line(arguments.common.quiet));
  write_plots(arguments, job, result);
  if (!job.table.empty()) apply_table_style(job.table, arguments.style);
  if (!job.conicity_table.empty()) apply_table_style(job.conicity_table, arguments.style);
  if (!arguments.view.empty())
    write_file(arguments.view,
               cloud_view_html(view_of_sections(job, result, arguments.view, arguments.scan)));
  if (!arguments.report.empty())
    write_file(arguments.report, measure_report_html(job, result,
                                                     {arguments.report, arguments.scan,
                                                      link_to(arguments.view, arguments.report)}));
  tell(arguments.common, describe_measurement(job, result));
  return result.usable() ? kExitDone : not_usable(result.not_usable);
}

/// What a user names in a file instead of a rail or a wheel.
int run_features(const MeasureArguments& arguments) {
  if (arguments.features.empty())
    throw Error("--features", "is missing",
                "name the file that says what to measure; see configs/features.yaml");
  FeaturesJob job;
  job.profiles = arguments.job.profiles, job.features = arguments.features, job.rig = arguments.job.rig;
  if (!arguments.common.output.empty()) job.table = arguments.common.output;
  job.threads = arguments.common.threads;
  job.other_outputs = {arguments.report};
  const FeaturesResult result = measure_features_job(job);
  for (const std::filesystem::path& table : {job.table, result.along_table})
    if (!table.empty()) apply_table_style(table, arguments.style);
  if (!arguments.report.empty()) write_file(arguments.report, features_report_html(job, result));
  for (std::size_t i = 0; i < result.along.size(); ++i) {
    const Estimate& estimate = result.along[i];
    say(arguments.common, result.file.along[i].name + ": " +
                              (estimate.value ? fmt::format("{:.4f} mm, sigma {:.4f}", *estimate.value,
                                                            estimate.sigma.value_or(0))
                                              : estimate.reason));
  }
  tell(arguments.common, describe_calibration_error(result.rig, result.calibration, job.profiles));
  say(arguments.common, fmt::format("{} of {} complete -> {}", result.num_complete,
                                    counted(result.rows.size(), "section"), job.table.string()));
  return result.num_complete > 0 || result.file.measurements.empty()
             ? kExitDone
             : not_usable("no section shows all that is measured; the column `missing` says why");
}

/// What the sections are held against: outlines, an earlier measurement, a track's second rail and a
/// wheelset.
void add_reference_options(CLI::App& command, MeasureArguments& arguments) {
  command.add_option(
      "--nominal", arguments.job.reference.nominal,
      "the new rail or wheel: a name, an outline file, a recorded profile (baseline), or auto [60E1, S1002]");
  command.add_option(
      "--baseline", arguments.job.reference.baseline,
      "an earlier measurement (profiles.csv, .ban, .whl ...) as reference; --nominal guides it");
  add_choice<bool>(command, "--rails", arguments.job.reference.two_rails, {{"one", false}, {"two", true}},
                   "one or two: sensors over both rails of a track; measures the gauge between them [one]");
  command.add_option("--nominal-right", arguments.job.reference.nominal_right,
                     "with --rails two: the new rail at -y [as --nominal]");
  command.add_option("--wheelset", arguments.job.reference.wheelset,
                     "with --rails two: wheels (e.g. S1002, or as `conicity --wheel`) whose equivalent "
                     "conicity on each section is wanted");
  command.add_option("--wheelset-right", arguments.job.reference.wheelset_right,
                     "its right wheel, if it is another");
  command.add_option("--conicity", arguments.job.conicity_table,
                     "with --wheelset: table of every section's conicity over the amplitude (csv)");
}

/// Whether the option does anything with this kind.
bool is_used(const std::string& option, const std::string& kind) {
  static const std::set<std::string> of_features{"profiles", "--kind",      "--features",
                                                 "--report", "--csv-style", "--rig",
                                                 "--output", "--threads",   "--quiet"};
  if (kind == "features") return of_features.contains(option);
  return option != "--features" && (kind == "wheel" || !option.starts_with("--wheel."));
}

}  // namespace

void add_measure_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("measure", "sections to wear and dimensions of rails and wheels");
  auto arguments = std::make_shared<MeasureArguments>();
  command
      ->add_option("profiles", arguments->job.profiles,
                   "sections: profiles.csv, or one of .ban .whl .mpt .prr .prw")
      ->required();
  one_of(command->add_option("--kind", arguments->kind,
                             "rail, wheel, or features (of any object, named in --features)"),
         {"rail", "wheel", "features"})
      ->required();
  command->add_option("--features", arguments->features,
                      "with --kind features: file of features and what to measure between them (YAML)");
  add_reference_options(*command, *arguments);
  command
      ->add_option("--require", arguments->job.options.required,
                   "what you need of each section, e.g. vertical_wear,side_wear: a row is ok where these are "
                   "known, exit code 3 where none of them is [all]")
      ->delimiter(',');
  command->add_option("--scan", arguments->scan, "scan file: the report links to its pictures");
  command->add_option("--limits", arguments->limits_file, "file of limits (YAML)");
  command->add_option("--report", arguments->report, "report to look at (HTML)");
  command->add_option(
      "--view", arguments->view,
      "page that shows the sections in 3D, coloured by their deviation from the nominal (HTML)");
  add_table_style_option(*command, arguments->style);
  command->add_option("--plot", arguments->plot,
                      "draws the section of this frame (PNG beside the table); may be repeated");
  command->add_option("--export", arguments->job.export_folder,
                      "writes each registered section there (.ban, .whl or .prr, .prw)");
  add_choice<SectionFormat>(*command, "--export-format", arguments->job.export_format,
                            {{"miniprof", SectionFormat::kMiniProf}, {"simpack", SectionFormat::kSimpack}},
                            "miniprof or simpack [miniprof]");
  command->add_option(
      "--rig", arguments->job.rig,
      "rig file: what its calibration errs by counts in the predicted errors [the rig that the "
      "sections' record (PROFILES.run.yaml) names, if it is still the same]");
  add_common_options(*command, arguments->common,
                     "table of measurements, .csv or .xlsx (default: measurements.csv)");
  add_field_options<RailOptions>(*command, "", arguments->rail);
  add_field_options<WheelOptions>(*command, "wheel.", arguments->wheel);
  add_field_options<RegistrationOptions>(*command, "registration.", arguments->registration);
  add_field_options<ConicityOptions>(*command, "conicity.", arguments->conicity);
  add_field_options<Limits>(*command, "limit.", arguments->limit);
  command->add_option("--max-overlap-gap-mm", arguments->job.options.max_overlap_gap_mm,
                      "between two sensors on the head: above, the calibration is in doubt [0.1]");
  command->callback([arguments, command, &run] {
    const std::string& kind = arguments->kind;
    refuse_unused(*command, "--kind " + kind, [&](const std::string& option) {
      return is_used(option, kind) ? "" : "leave it out, or give another --kind";
    });
    arguments->job.kind = arguments->kind == "wheel" ? ObjectKind::kWheel : ObjectKind::kRail;
    run = [arguments] {
      return arguments->kind == "features" ? run_features(*arguments) : run_measure(*arguments);
    };
  });
}

}  // namespace lightstripe
