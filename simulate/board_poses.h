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

/// How the sensors have moved from where they stood at travel 0, as the object sees it: mm along x or degrees
/// about the wheel's axis. World frame at travel 0.
Rigid3 moved_at(const Scene& scene, double travel);
/// The same at a position of the motion calibration.
Rigid3 moved_in_motion(const Scene& scene, int position);
/// The same in a frame of the scan; a rig led by hand sways besides.
Rigid3 moved_in_scan(const Scene& scene, int frame);

}  // namespace lightstripe
