// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/calibrate.h"

#include <fmt/format.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/camera_file.h"
#include "io/rig_file.h"
#include "pipeline/calibration_advice.h"
#include "pipeline/run_record.h"
#include "report/board_overlay.h"
#include "report/calibration_report.h"

namespace lightstripe {
namespace {

struct CalibrateArguments {
  CommonOptions common;
  std::string session;
  CalibrationFiles files;
  Overrides extraction, calibration;
};

std::string describe_rejected(const std::vector<RejectedImage>& rejected) {
  std::string text;
  for (const auto& image : rejected)
    text += fmt::format("  {:<10} {:<16} {}\n", image.sensor, image.image, image.reason);
  return text.empty() ? "" : "left out:\n" + text;
}

std::string describe_views(const std::vector<ViewResidual>& views) {
  std::string text = "  sensor     image             corners  rms px    stripe  rms px  left out\n";
  for (const auto& v : views)
    text += fmt::format("  {:<10} {:<16} {:>8} {:>7.3f}  {:>8} {:>7}  {:>8}\n", v.sensor, v.image, v.corners,
                        v.board_rms_px, v.stripe_points,
                        v.stripe_points > 0 ? fmt::format("{:.3f}", v.stripe_rms_px) : "-", v.left_out);
  return text;
}

std::string describe_lenses(const std::vector<LensChoice>& lenses) {
  std::string text;
  for (const auto& choice : lenses) {
    text += fmt::format("{}: lens model {}", choice.sensor, enum_name(choice.lens));
    std::string tried;
    for (const auto& trial : choice.trials)
      tried +=
          fmt::format("{}{} {:.4f}", tried.empty() ? "" : ", ", enum_name(trial.lens), trial.held_out_rms_px);
    text += tried.empty() ? "\n" : fmt::format(" (error on views left out, px: {})\n", tried);
  }
  return text;
}

/// Each sensor's camera as <name>.opencv.yaml, .ros.yaml and .cameramodel; what a format cannot hold is told.
void write_cameras(const std::filesystem::path& folder, const Rig& rig) {
  for (const Sensor& sensor : rig.sensors) {
    const auto base = (folder / sensor.name).string();
    write_file(base + ".opencv.yaml", opencv_camera_yaml(sensor.camera));
    try {
      write_file(base + ".cameramodel", mrcal_cameramodel(sensor.camera, sensor.rig_from_camera.inverse()));
      write_file(base + ".ros.yaml", ros_camera_info_yaml(sensor.camera, sensor.name));
    } catch (const Error& error) {
      warn(sensor.name + ": " + error.what());
    }
  }
}

}  // namespace

std::string describe_calibration(const SessionObservations& seen, const CalibrationResult& result) {
  std::string text = fmt::format("boards: found in {} of {} images\n", seen.boards_found, seen.images);
  text += describe_rejected(seen.rejected);
  text += describe_views(result.summary.views);
  text += describe_lenses(result.summary.lenses);
  const RigQuality& quality = result.rig.quality;
  for (const auto& s : quality.sensors)
    text += fmt::format("{}: corners {:.3f} px rms in {} views, stripe {:.3f} px rms in {} views\n", s.name,
                        s.board_rms_px, s.board_views, s.stripe_rms_px, s.stripe_views);
  if (quality.section_shape_sigma_mm > 0)
    text += fmt::format("predicted error of a section: {:.4f} mm in shape, {:.3f} mm in place\n",
                        quality.section_shape_sigma_mm, quality.section_absolute_sigma_mm);
  if (quality.cross_validation_ratio)
    text += fmt::format("every other view against the rest: sections differ by {:.2f} times the prediction\n",
                        *quality.cross_validation_ratio);
  if (!quality.weakest.empty()) text += "weakest: " + quality.weakest + "\n";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

int calibrate_session(const std::string& session_file, const Overrides& extraction,
                      const Overrides& calibration, const CommonOptions& common,
                      const CalibrationFiles& files) {
  const ThreadLimit limit(common);
  const Session session = read_session(session_file);
  ExtractionOptions extraction_options;
  read_subtree(session.extraction, extraction_options);
  apply_overrides(extraction_options, extraction);
  CalibrationOptions calibration_options;
  read_subtree(session.calibration, calibration_options);
  apply_overrides(calibration_options, calibration);

  const SessionObservations seen = observe_session(session, extraction_options, common);
  const CalibrationResult result = calibrate_rig(seen.observations, calibration_options);
  say(common, describe_calibration(seen, result));
  for (const auto& warning : result.rig.quality.warnings) warn(warning);
  if (!files.overlay.empty()) write_overlays(files.overlay, seen.pictures);
  if (!files.report.empty()) {
    write_file(files.report, calibration_report(seen, result));
    say(common, "report -> " + files.report);
  }
  const std::string output = common.output.empty() ? "rig.yaml" : common.output;
  if (!result.summary.usable)
    return not_usable(result.summary.message + calibration_advice(session, seen) + " (" + output +
                      " is not written)");
  write_file(output, rig_to_yaml(result.rig));
  if (!files.camera_folder.empty()) write_cameras(files.camera_folder, result.rig);
  write_run_record(output, "calibrate", {session_file},
                   "extraction:\n" + indented(dump_yaml(extraction_options)) + "calibration:\n" +
                       indented(dump_yaml(calibration_options)));
  say(common, "rig -> " + output);
  return kExitDone;
}

void add_calibrate_command(CLI::App& app, Command& run) {
  auto* command =
      app.add_subcommand("calibrate", "cameras, laser planes, rig and motion from checkerboard images");
  auto arguments = std::make_shared<CalibrateArguments>();
  command->add_option("session", arguments->session, "calibration session (YAML)")->required();
  add_common_options(*command, arguments->common, "rig file (default: rig.yaml)");
  command->add_option("--report", arguments->files.report,
                      "calibration.html: verdict, residuals, uncertainty, pictures");
  command->add_option("--overlay", arguments->files.overlay,
                      "folder for the pictures with corners and stripes drawn in");
  command->add_option("--cameras", arguments->files.camera_folder,
                      "folder for the cameras as OpenCV, ROS and mrcal read them");
  add_field_options<ExtractionOptions>(*command, "extraction.", arguments->extraction);
  add_field_options<CalibrationOptions>(*command, "calibration.", arguments->calibration);
  command->callback([arguments, &run] {
    run = [arguments] {
      return calibrate_session(arguments->session, arguments->extraction, arguments->calibration,
                               arguments->common, arguments->files);
    };
  });
}

}  // namespace lightstripe
