// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which pictures of a session belong together, and how they are read.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/session_file.h"
#include "pipeline/background_pictures.h"
#include "pipeline/observe_session.h"

namespace lightstripe {

/// What is to be looked at: one pose of the board before one sensor.
struct ViewTask {
  int sensor = 0;       ///< index in the session
  bool motion = false;  ///< a view of the motion calibration
  double travel = 0;
  std::string pose;
  std::filesystem::path board;
  std::filesystem::path laser;  ///< empty: the stripe is in the board's image, or there is none (motion)
  bool camera_only = false;     ///< the board is there for the camera, without laser
  const BackgroundPictures* background = nullptr;  ///< subtracted from the picture with the stripe
};

/// A sensor's boards, each with its picture of the laser, paired by the text that the '*' stands for; a laser
/// image alone is reported, not used. `background`: the sensor's, may be null.
std::vector<ViewTask> sensor_tasks(const Session& session, int sensor, const BackgroundPictures* background,
                                   std::vector<RejectedImage>& rejected);

/// The boards of the motion calibration, each with its place in the travel table.
std::vector<ViewTask> motion_tasks(const Session& session);

/// One for each sensor, null where it has none.
using SensorBackgrounds = std::vector<std::unique_ptr<BackgroundPictures>>;
SensorBackgrounds sensor_backgrounds(const Session& session);

/// Those of every sensor, then those of the motion.
std::vector<ViewTask> session_tasks(const Session& session, const SensorBackgrounds& backgrounds,
                                    std::vector<RejectedImage>& rejected);

/// Sensor and file of every board picture, in the order of session_tasks().
std::vector<std::pair<std::string, std::filesystem::path>> board_pictures(const Session& session);

/// One channel for each sensor: what the session says, or the vote of the pictures that show its laser; where
/// the print is known, the laser's own channel.
std::vector<Channel> sensor_channels(const Session& session, const std::vector<ViewTask>& tasks);

}  // namespace lightstripe
