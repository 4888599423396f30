// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Rays through a camera onto surfaces in the light of a lamp and a laser sheet -> grey levels before the
// sensor's noise.
#pragma once

#include "core/image.h"
#include "simulate/optics.h"
#include "simulate/scene.h"
#include "simulate/surfaces.h"

namespace lightstripe {

/// Grey levels along one ray, or of one picture: everything, and the laser's part of it.
struct ShadedRay {
  double total = 0, laser = 0;
};
struct Light {
  Image<float> total;
  Image<float> laser;  ///< empty where nothing needs it, or the laser is off
};

/// What the laser adds at a point of a surface, grey levels: the sheet's gaussian and the surface's glow, the
/// fan's fading, 1/distance, incidence (Lambert) and highlight (Phong), nothing in the shadow of something
/// else.
double laser_level(const World& world, const View& view, const Imaging& imaging,
                   const Eigen::Vector3d& p_world, const SurfaceHit& hit);

/// The grey levels along one ray.
ShadedRay shade(const World& world, const View& view, const Imaging& imaging, const Ray& ray);

/// The image of one exposure: one ray a pixel where the picture is smooth, `imaging.samples` where it
/// changes, then the lens' blur. The grid belongs to the view's sensor, with a margin of blur_margin() + 1 at
/// least.
Light render_light(const World& world, const View& view, const RayGrid& rays, const Imaging& imaging);
/// All light of render_light in one picture.
Image<float> render(const World& world, const View& view, const RayGrid& rays, const Imaging& imaging);

/// How far the lens' blur reaches, px.
int blur_margin(const Imaging& imaging);

}  // namespace lightstripe
