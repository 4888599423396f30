// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A scene's sensors as geometry: cameras with poses, laser sheets, the ray of every pixel, the true rig.
#pragma once

#include <string>
#include <vector>

#include "core/rig.h"
#include "simulate/scene.h"
#include "simulate/surfaces.h"

namespace lightstripe {

/// One sensor, world frame at travel 0.
struct SimulatedSensor {
  std::string name;
  Camera camera;
  Rigid3 world_from_camera;
  Plane sheet;              ///< contains `source`, `axis` and `across`
  Eigen::Vector3d source;   ///< mm
  Eigen::Vector3d axis;     ///< unit, the fan's middle
  Eigen::Vector3d across;   ///< unit, perpendicular to it in the sheet
  double reference_mm = 0;  ///< distance at which `laser.brightness` holds
  LaserSheet laser;
};

SimulatedSensor make_sensor(const SceneSensor& sensor);
std::vector<SimulatedSensor> make_sensors(const Scene& scene);

/// The rig that a perfect calibration of this scene finds (docs/conventions.md, "Frames"). `up_hint` is what
/// calibration.yaml gets: the world's z in the first camera's frame.
Rig true_rig(const Scene& scene, const std::vector<SimulatedSensor>& sensors);
Eigen::Vector3d up_hint(const SimulatedSensor& first);

/// The unit direction of the axis that the scene's wheel turns about, world frame, turned so that u grows
/// with the rig's y; positive angles are right-handed about it.
Eigen::Vector3d turning_axis(const Scene& scene);

/// rig_from_world at travel 0.
Rigid3 rig_from_world(const Rig& rig, const std::vector<SimulatedSensor>& sensors);

/// Directions (world frame, mm, depth 1) that the pixels see, with `margin` pixels around the image so that
/// blur and sub-pixel samples at its border know what lies beyond.
struct RayGrid {
  int margin = 0;
  int width = 0, height = 0;  ///< of the grid: the image and twice the margin
  std::vector<Eigen::Vector3d> directions;

  const Eigen::Vector3d& at(int x, int y) const {
    return directions[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
  }
  /// Between grid points by bilinear interpolation: within 2e-5 px of the camera model for lenses of our
  /// kind.
  Eigen::Vector3d between(double x, double y) const;
};

RayGrid make_ray_grid(const SimulatedSensor& sensor, int margin);

/// What one exposure sees: a sensor moved from where it stood at travel 0, with its lamp and its laser.
struct View {
  const SimulatedSensor* sensor = nullptr;
  Rigid3 moved;            ///< world from world at travel 0
  double ambient = 0;      ///< grey level of white that faces the lamp
  double laser_power = 0;  ///< share of the laser's brightness; 0 = off

  Eigen::Vector3d eye() const { return moved * sensor->world_from_camera.translation; }
  Eigen::Vector3d source() const { return moved * sensor->source; }
  /// The ray of a direction of the sensor at travel 0 (RayGrid).
  Ray ray(const Eigen::Vector3d& direction) const { return {eye(), moved.rotation * direction}; }
};

/// Where a point of the world at travel 0 lies in the image; nothing outside it or behind the camera.
std::optional<Eigen::Vector2d> pixel_of(const View& view, const Eigen::Vector3d& p_world);

}  // namespace lightstripe
