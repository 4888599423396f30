// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A calibration session on disk -> observations -> rig.
#pragma once

#include <string>
#include <vector>

#include "apps/command.h"
#include "calib/calibrate_rig.h"
#include "calib/observe_board.h"
#include "io/session_file.h"

namespace lightstripe {

/// An image that gives the calibration nothing, and why.
struct RejectedImage {
  std::string sensor, image, reason;
};

struct SessionObservations {
  CalibrationObservations observations;
  std::vector<RejectedImage> rejected;  ///< images without a usable board, or without a usable stripe
  int images = 0;
  int boards_found = 0;
};

/// Reads and looks at every image of the session, in parallel; the order of the views is that of the file names.
SessionObservations observe_session(const Session& session, const ExtractionOptions& extraction, const CommonOptions& common);

/// The table of sensors and views that `lightstripe calibrate` prints.
std::string describe_calibration(const SessionObservations& seen, const CalibrationResult& result);

/// The command itself, also used by the demo.
int calibrate_session(const std::string& session_file, const Overrides& extraction, const Overrides& calibration,
                      const CommonOptions& common);

}  // namespace lightstripe
