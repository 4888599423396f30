// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Small scenes for the tests of simulate.
#pragma once

#include <numbers>

#include "simulate/render.h"
#include "simulate/scene_world.h"

namespace lightstripe {

/// Looks straight down on the origin from 500 mm; image x = world x, image y = -world y; 3 px a mm. The laser
/// stands above y = -300 and its sheet is the plane x = 0.
inline SceneSensor looking_down(int width = 320, int height = 240) {
  SceneSensor sensor;
  sensor.name = "above";
  sensor.position = {0, 0, 500};
  sensor.target = {0, 0, 0};
  sensor.up = {0, 1, 0};
  sensor.image_size = {width, height};
  sensor.focal_px = {1500, 1500};
  sensor.principal_point_px = {0.5 * (width - 1), 0.5 * (height - 1)};
  sensor.distortion = {};
  sensor.laser.source = {0, -300, 400};
  sensor.laser.aim = {0, 0, 0};
  sensor.laser.normal = {1, 0, 0};
  return sensor;
}

inline Imaging noise_free() {
  Imaging imaging;
  imaging.read_noise = 0;
  imaging.electrons_per_level = 0;
  return imaging;
}

inline View lit_view(const SimulatedSensor& sensor, double ambient) { return {&sensor, {}, ambient, 1}; }

inline Image<float> rendered(const World& world, const View& view, const Imaging& imaging) {
  return render(world, view, make_ray_grid(*view.sensor, blur_margin(imaging) + 1), imaging);
}

}  // namespace lightstripe
