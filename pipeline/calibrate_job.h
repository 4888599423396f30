// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe calibrate`: a calibration session on disk -> a rig on disk.
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "calib/calibrate_rig.h"
#include "extraction/options.h"
#include "io/session_file.h"
#include "pipeline/job.h"
#include "pipeline/observe_session.h"

namespace lightstripe {

struct CalibrateJob {
  std::filesystem::path session_file;  ///< named in messages and in the run's record
  Session session;
  ExtractionOptions extraction;            ///< in effect: the session's own are merged
  CalibrationOptions calibration;          ///< in effect: the session's own are merged
  std::filesystem::path rig = "rig.yaml";  ///< is written if the calibration is usable; empty: not written
  std::filesystem::path camera_folder;  ///< for the cameras as OpenCV, ROS and mrcal read them; empty: none
  std::vector<std::filesystem::path> other_outputs;  ///< what else is written: must not be an input either
  std::filesystem::path overlay_folder;              ///< where the pictures' overlays will be; empty: none
  int threads = 0;                                   ///< 0 = all cores
};

/// The job as the session file describes it; what else is wanted is set in it afterwards.
CalibrateJob read_calibrate_job(const std::filesystem::path& session_file);

struct CalibrateResult {
  SessionObservations seen;
  CalibrationResult calibration;      ///< the rig, its predicted errors and the summary
  std::vector<std::string> warnings;  ///< about the result and about files that could not be written
  std::string not_usable;             ///< why, and what to do; empty: the result is usable
  bool usable() const { return not_usable.empty(); }
};

/// Looks at the session's pictures, calibrates, and writes rig, cameras and the run's record
/// (<rig>.run.yaml). An Error where a file is wrong, or where a stop was asked for.
CalibrateResult calibrate(const CalibrateJob& job, const ProgressCallback& progress = {},
                          const std::stop_token& stop = {});

}  // namespace lightstripe
