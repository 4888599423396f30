// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibrate_job.h"

#include "apps/command.h"
#include "apps/options.h"
#include "apps/progress.h"
#include "io/atomic_file.h"
#include "report/board_overlay.h"
#include "report/calibration_report.h"
#include "report/calibration_text.h"

namespace lightstripe {
namespace {

struct CalibrateArguments {
  CommonOptions common;
  std::string session;
  std::string report, overlay, camera_folder;
  Overrides extraction, calibration;
};

CalibrateJob job_of(const CalibrateArguments& arguments) {
  CalibrateJob job = read_calibrate_job(arguments.session);
  apply_overrides(job.extraction, arguments.extraction);
  apply_overrides(job.calibration, arguments.calibration);
  if (!arguments.common.output.empty()) job.rig = arguments.common.output;
  job.camera_folder = arguments.camera_folder;
  job.overlay_folder = arguments.overlay;
  job.other_outputs = {arguments.report};
  job.threads = arguments.common.threads;
  return job;
}

int run_calibrate(const CalibrateArguments& arguments) {
  const CommonOptions& common = arguments.common;
  const CalibrateJob job = job_of(arguments);
  const CalibrateResult result = calibrate(job, progress_line(common.quiet));
  say(common, describe_calibration(result.seen, result.calibration));
  for (const auto& warning : result.warnings) warn(warning);
  if (!arguments.overlay.empty()) write_overlays(arguments.overlay, result.seen.pictures);
  if (!arguments.report.empty()) {
    write_file(arguments.report, calibration_report(result.seen, result.calibration));
    say(common, "report -> " + arguments.report);
  }
  if (!result.usable()) return not_usable(result.not_usable + " (" + job.rig.string() + " is not written)");
  say(common, "rig -> " + job.rig.string());
  return kExitDone;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Command& run) {
  auto* command =
      app.add_subcommand("calibrate", "cameras, laser planes, rig and motion from checkerboard images");
  auto arguments = std::make_shared<CalibrateArguments>();
  command->add_option("session", arguments->session, "calibration session (YAML)")->required();
  add_common_options(*command, arguments->common, "rig file (default: rig.yaml)");
  command->add_option("--report", arguments->report,
                      "calibration.html: verdict, residuals, uncertainty, pictures");
  command->add_option("--overlay", arguments->overlay,
                      "folder for the pictures with corners and stripes drawn in");
  command->add_option("--cameras", arguments->camera_folder,
                      "folder for the cameras as OpenCV, ROS and mrcal read them");
  add_field_options<ExtractionOptions>(*command, "extraction.", arguments->extraction);
  add_field_options<CalibrationOptions>(*command, "calibration.", arguments->calibration);
  command->callback([arguments, &run] { run = [arguments] { return run_calibrate(*arguments); }; });
}

}  // namespace lightstripe
