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

/// What the laser adds at a point of a surface, grey levels: the sheet's gaussian, the fan's fading,
/// 1/distance, incidence (Lambert) and highlight (Phong), nothing in the shadow of something else.
double laser_level(const World& world, const View& view, const Imaging& imaging,
                   const Eigen::Vector3d& p_world, const SurfaceHit& hit);

/// The grey level along one ray.
double shade(const World& world, const View& view, const Imaging& imaging, const Ray& ray);

/// The image of one exposure: one ray a pixel where the picture is smooth, `imaging.samples` where it
/// changes, then the lens' blur. The grid belongs to the view's sensor, with a margin of blur_margin() + 1 at
/// least.
Image<float> render(const World& world, const View& view, const RayGrid& rays, const Imaging& imaging);

/// How far the lens' blur reaches, px.
int blur_margin(const Imaging& imaging);

}  // namespace lightstripe
