// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Where the checkerboard is held: random poses that every sensor can use.
#pragma once

#include <vector>

#include "simulate/optics.h"
#include "simulate/scene.h"
#include "simulate/surfaces.h"

namespace lightstripe {

/// The board of the plan, at a pose (world_from_board).
BoardSurface make_board(const BoardPlan& plan, const Rigid3& world_from_board);

Target target_of(const BoardPlan& plan);

/// world_from_board of the session's poses. Each is drawn again until all sensors see the whole pattern, not
/// too slanted, and each laser crosses it; an Error if a pose cannot be found. The last `plan.cut_off` poses
/// instead leave the first sensor's image with a part of their corners.
std::vector<Rigid3> draw_board_poses(const Scene& scene, const std::vector<SimulatedSensor>& sensors);

/// world_from_board of the one board of the motion calibration, in view of its sensor over the whole travel.
Rigid3 draw_motion_board(const Scene& scene, const std::vector<SimulatedSensor>& sensors);

/// Index of the sensor that watches the motion calibration.
std::size_t motion_sensor(const Scene& scene);

/// How far the sensors stand from where they were at travel 0, mm, world.
Eigen::Vector3d shift_at(const Scene& scene, double travel_mm);

}  // namespace lightstripe
