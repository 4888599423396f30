// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A calibration session on disk -> observations -> rig.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/command.h"
#include "calib/board/observe_board.h"
#include "calib/calibrate_rig.h"
#include "io/session_file.h"

namespace lightstripe {

/// An image that gives the calibration nothing, and why.
struct RejectedImage {
  std::string sensor, image, reason;
};

/// What was found in one picture, for overlays.
struct SeenPicture {
  std::string sensor, image, reason;   ///< reason: of what it does not give; empty if all is well
  std::filesystem::path board, laser;  ///< laser may be empty
  std::vector<Eigen::Vector2d> corners;
  std::vector<std::vector<StripePoint>> stripes;
};

struct SessionObservations {
  CalibrationObservations observations;
  std::vector<SeenPicture> pictures;    ///< every board picture, in the order of the views
  std::vector<RejectedImage> rejected;  ///< images without a usable board, or without a usable stripe
  int images = 0;
  int boards_found = 0;
};

/// Reads and looks at every image of the session, in parallel; the order of the views is that of the file
/// names.
SessionObservations observe_session(const Session& session, const ExtractionOptions& extraction,
                                    const CommonOptions& common);

/// The table of sensors and views that `lightstripe calibrate` prints.
std::string describe_calibration(const SessionObservations& seen, const CalibrationResult& result);

/// What `calibrate` writes besides the rig; empty: not.
struct CalibrationFiles {
  std::string report;         ///< calibration.html
  std::string overlay;        ///< folder of pictures with corners and stripes drawn in
  std::string camera_folder;  ///< folder of the cameras in the formats of OpenCV, ROS and mrcal
};

/// The command itself, also used by the demo.
int calibrate_session(const std::string& session_file, const Overrides& extraction,
                      const Overrides& calibration, const CommonOptions& common,
                      const CalibrationFiles& files = {});

}  // namespace lightstripe
