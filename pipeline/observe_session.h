// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A calibration session on disk -> what its pictures show.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "calib/board/observe_board.h"
#include "calib/calibrate_rig.h"
#include "extraction/options.h"
#include "io/session_file.h"
#include "pipeline/job.h"

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
  /// Of each sensor with a laser: the channel that all its pictures are read in.
  std::vector<std::pair<std::string, Channel>> channels;
};

/// Reads and looks at every image of the session, in parallel; the order of the views is that of the file
/// names. A stop that is asked for ends it by an Error.
SessionObservations observe_session(const Session& session, const ExtractionOptions& extraction,
                                    const ProgressCallback& progress = {}, const std::stop_token& stop = {});

}  // namespace lightstripe
