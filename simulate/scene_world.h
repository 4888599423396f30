// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The scene's objects as surfaces.
#pragma once

#include "core/outline.h"
#include "simulate/scene.h"
#include "simulate/surfaces.h"

namespace lightstripe {

/// Position of the scan's frame, mm or degrees.
inline double travel_of(const Scene& scene, int frame) {
  return frame * (scene.turns() ? scene.scan.step_deg : scene.scan.step_mm);
}

struct RailWear {
  double vertical_mm = 0, side_mm = 0;
};
RailWear wear_at(const RailObject& rail, const ScanPlan& scan, int frame);

/// The outline of a rail that a frame sees, (u, v) about the top of the unworn rail, without inclination.
Outline rail_outline(const RailObject& rail, const ScanPlan& scan, const Outline& nominal, int frame);

/// world_from_solid of the rail: (x, u, v) to the world.
Rigid3 world_from_rail(const RailObject& rail);

/// The section of the scene's wheel, (u, v) about the unworn tread datum.
Outline wheel_outline(const Scene& scene, const Outline& nominal);

/// world_from_solid of the wheel: x along its axis to the field side, origin in the plane of the datum.
Rigid3 world_from_wheel(const Scene& scene);

/// The unworn outlines of the scene's objects; empty where there is none.
struct NominalOutlines {
  Outline main;        ///< of the rail or the wheel
  Outline other_rail;  ///< of the second rail
};
NominalOutlines nominal_outlines(const Scene& scene);

/// What a frame of the scan sees.
World scan_world(const Scene& scene, const NominalOutlines& nominal, int frame);

/// Whether every frame of the scan sees the same picture, noise and reflections apart.
bool same_in_all_frames(const Scene& scene);

}  // namespace lightstripe
