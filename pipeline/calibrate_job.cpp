// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibrate_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/camera_file.h"
#include "io/images.h"
#include "io/output_guard.h"
#include "io/rig_file.h"
#include "pipeline/calibration_advice.h"
#include "pipeline/overlay_files.h"
#include "pipeline/run_record.h"
#include "pipeline/scan_lines.h"
#include "pipeline/session_tasks.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// Each sensor's camera as <name>.opencv.yaml, .ros.yaml and .cameramodel; what a format cannot hold becomes
/// a warning.
void write_cameras(const fs::path& folder, const Rig& rig, std::vector<std::string>& warnings) {
  for (const Sensor& sensor : rig.sensors) {
    const auto base = (folder / sensor.name).string();
    write_file(base + ".opencv.yaml", opencv_camera_yaml(sensor.camera));
    try {
      write_file(base + ".cameramodel", mrcal_cameramodel(sensor.camera, sensor.rig_from_camera.inverse()));
      write_file(base + ".ros.yaml", ros_camera_info_yaml(sensor.camera, sensor.name));
    } catch (const Error& error) {
      warnings.push_back(sensor.name + ": " + error.what());
    }
  }
}

/// The session with all that it names.
std::vector<fs::path> inputs_of(const CalibrateJob& job) {
  std::vector<fs::path> inputs{job.session_file};
  for (const fs::path& file : files_of(job.session)) inputs.push_back(file);
  std::vector<fs::path> once;  // a board with the stripe on it serves twice
  for (const fs::path& input : inputs)
    if (std::find(once.begin(), once.end(), input) == once.end()) once.push_back(input);
  return once;
}

/// In what channel each sensor's lines were looked for, and how wide they are.
std::vector<SensorLines> lines_of(const SessionObservations& seen) {
  std::vector<SensorLines> all;
  LineWidths widths(seen.channels.size());
  for (std::size_t s = 0; s < seen.channels.size(); ++s) {
    const auto& [sensor, channel] = seen.channels[s];
    for (const SeenPicture& picture : seen.pictures)
      if (picture.sensor == sensor)
        for (const auto& line : picture.stripes)
          if (!line.empty()) widths.add(line_width(static_cast<int>(s), line));
    all.push_back(widths.describe(s, sensor, channel));
  }
  return all;
}

void write_results(const CalibrateJob& job, CalibrateResult& result) {
  const Rig& rig = result.calibration.rig;
  if (!job.rig.empty()) write_file(job.rig, rig_to_yaml(rig));
  if (!job.camera_folder.empty()) write_cameras(job.camera_folder, rig, result.warnings);
  if (job.rig.empty()) return;
  write_run_record(job.rig, "calibrate", inputs_of(job),
                   lines_yaml(lines_of(result.seen)) + "extraction:\n" + indented(dump_yaml(job.extraction)) +
                       "calibration:\n" + indented(dump_yaml(job.calibration)));
}

void guard(const CalibrateJob& job) {
  std::vector<fs::path> inputs = files_of(job.session), outputs = job.other_outputs;
  inputs.push_back(job.session_file);
  if (!job.overlay_folder.empty())
    for (const fs::path& file : board_overlay_files(board_pictures(job.session), job.overlay_folder))
      outputs.push_back(file);
  if (!job.rig.empty()) outputs.insert(outputs.end(), {job.rig, job.rig.string() + ".run.yaml"});
  if (!job.camera_folder.empty())
    for (const SessionSensor& sensor : job.session.sensors)
      for (const char* end : {".opencv.yaml", ".ros.yaml", ".cameramodel"})
        outputs.push_back(job.camera_folder / (sensor.name + end));
  guard_outputs(inputs, outputs);
}

}  // namespace

CalibrateJob read_calibrate_job(const fs::path& session_file) {
  CalibrateJob job;
  job.session_file = session_file;
  job.session = read_session(session_file);
  read_subtree(job.session.extraction, job.extraction);
  read_subtree(job.session.calibration, job.calibration);
  return job;
}

CalibrateResult calibrate(const CalibrateJob& job, const ProgressCallback& progress,
                          const std::stop_token& stop) {
  guard(job);
  const JobThreads threads(job.threads);
  CalibrateResult result;
  result.seen = observe_session(job.session, job.extraction, progress, stop);
  result.calibration = calibrate_rig(result.seen.observations, job.calibration);
  result.warnings = result.calibration.rig.quality.warnings;
  if (result.calibration.summary.usable)
    write_results(job, result);
  else
    result.not_usable = result.calibration.summary.message + calibration_advice(job.session, result.seen);
  return result;
}

}  // namespace lightstripe
