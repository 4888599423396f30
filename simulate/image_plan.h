// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which images a scene gives: every exposure with its file, its view and what stands before the sensor.
#pragma once

#include <string>
#include <vector>

#include "simulate/optics.h"
#include "simulate/scene.h"
#include "simulate/scene_world.h"
#include "simulate/surfaces.h"

namespace lightstripe {

struct PlannedImage {
  std::string file;        ///< relative to the output folder
  std::size_t sensor = 0;  ///< index into ImagePlan::sensors
  std::size_t world = 0;   ///< index into ImagePlan::worlds
  View view;               ///< points into ImagePlan::sensors
  int frame = -1;          ///< of the scan; -1: calibration
};

/// Movable, not copyable: the views point into it.
struct ImagePlan {
  std::vector<SimulatedSensor> sensors;
  std::vector<World> worlds;
  std::vector<PlannedImage> images;
  std::vector<Rigid3> board_poses;   ///< world_from_board, by the number in the images' names
  std::vector<Rigid3> motion_board;  ///< world_from_board, one entry or none
  NominalOutlines nominal;
  bool still_scan = false;  ///< every frame of the scan sees the same picture

  ImagePlan() = default;
  ImagePlan(ImagePlan&&) = default;
  ImagePlan(const ImagePlan&) = delete;
};

ImagePlan plan_images(const Scene& scene);

/// "007.png", "0007.png".
std::string board_file(int number);
std::string frame_file(int number);

}  // namespace lightstripe
