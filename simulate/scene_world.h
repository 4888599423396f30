// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The scene's objects as surfaces.
#pragma once

#include "core/outline.h"
#include "simulate/scene.h"
#include "simulate/surfaces.h"

namespace lightstripe {

/// Position of the scan's frame, mm.
inline double travel_of(const Scene& scene, int frame) { return frame * scene.scan.step_mm; }

struct RailWear {
  double vertical_mm = 0, side_mm = 0;
};
RailWear wear_at(const Scene& scene, int frame);

/// The outline of the rail that a frame sees, (u, v) about the top of the unworn rail, without inclination.
Outline rail_outline(const Scene& scene, const Outline& nominal, int frame);

/// world_from_solid of the rail: (x, u, v) to the world.
Rigid3 world_from_rail(const Scene& scene);

/// What a frame of the scan sees. `nominal`: the outline of scene.rail.profile, ignored if there is no rail.
World scan_world(const Scene& scene, const Outline& nominal, int frame);

/// Whether every frame of the scan sees the same picture, noise and reflections apart.
bool same_in_all_frames(const Scene& scene);

}  // namespace lightstripe
