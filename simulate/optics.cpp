// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/optics.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Eigen::Quaterniond looking_along(const Vector3d& direction, const Vector3d& up) {
  Eigen::Matrix3d world_from_camera;
  world_from_camera.col(2) = direction.normalized();
  world_from_camera.col(0) = direction.cross(up).normalized();
  world_from_camera.col(1) = world_from_camera.col(2).cross(world_from_camera.col(0));
  return Eigen::Quaterniond(world_from_camera).normalized();
}

Camera make_camera(const SceneSensor& sensor) {
  Camera camera;
  camera.width = sensor.image_size[0];
  camera.height = sensor.image_size[1];
  camera.fx = sensor.focal_px[0];
  camera.fy = sensor.focal_px[1];
  camera.cx = sensor.principal_point_px[0];
  camera.cy = sensor.principal_point_px[1];
  std::copy(sensor.distortion.begin(), sensor.distortion.end(), camera.distortion.begin());
  return camera;
}

/// The point of the axis nearest to the rig's origin stands for it.
void add_turning(const Scene& scene, const Rigid3& rig_from_world, Motion& motion) {
  motion.type = MotionType::kRotary;
  motion.axis_direction = rig_from_world.rotation * turning_axis(scene);
  const Vector3d center = rig_from_world * scene.wheel.center;
  motion.axis_point = center - motion.axis_direction * motion.axis_direction.dot(center);
}

}  // namespace

SimulatedSensor make_sensor(const SceneSensor& from) {
  SimulatedSensor out;
  out.name = from.name;
  out.camera = make_camera(from);
  out.world_from_camera = {looking_along(from.target - from.position, from.up), from.position};
  const Vector3d reach = from.laser.aim - from.laser.source;
  out.source = from.laser.source;
  out.axis = reach.normalized();
  out.reference_mm = reach.norm();
  const Vector3d normal = (from.laser.normal - from.laser.normal.dot(out.axis) * out.axis).normalized();
  out.across = normal.cross(out.axis);
  out.sheet = canonical({normal, normal.dot(out.source)});
  out.laser = from.laser;
  return out;
}

std::vector<SimulatedSensor> make_sensors(const Scene& scene) {
  std::vector<SimulatedSensor> out;
  for (const SceneSensor& sensor : scene.sensors) out.push_back(make_sensor(sensor));
  return out;
}

Vector3d up_hint(const SimulatedSensor& first) {
  return first.world_from_camera.rotation.conjugate() * Vector3d::UnitZ();
}

Rig true_rig(const Scene& scene, const std::vector<SimulatedSensor>& sensors) {
  Rig rig;
  for (const SimulatedSensor& sensor : sensors) {
    const Rigid3 camera_from_world = sensor.world_from_camera.inverse();
    rig.sensors.push_back({sensor.name, sensor.camera, {}, {}});
    rig.sensors.back().laser_planes.push_back(canonical(transformed(
        sensor.sheet, camera_from_world.rotation.toRotationMatrix(), camera_from_world.translation)));
  }
  const Rigid3 first_from_world = sensors.front().world_from_camera.inverse();
  const bool moves = scene.motion.positions > 0 && !scene.turns();
  // d > 0: the canonical normal looks away from the camera.
  const Vector3d x =
      moves ? first_from_world.rotation * Vector3d::UnitX() : rig.sensors.front().laser_planes.front().normal;
  const Rigid3 rig_from_first{rig_rotation(x, up_hint(sensors.front())), Vector3d::Zero()};
  for (std::size_t i = 0; i < sensors.size(); ++i)
    rig.sensors[i].rig_from_camera = rig_from_first * first_from_world * sensors[i].world_from_camera;
  rig.sensors.front().rig_from_camera.translation.setZero();
  rig.motion.type = moves ? MotionType::kLinear : MotionType::kNone;
  rig.motion.moves = scene.motion.moves;
  if (scene.turns()) add_turning(scene, rig_from_world(rig, sensors), rig.motion);
  return rig;
}

Vector3d turning_axis(const Scene& scene) {
  const SimulatedSensor first = make_sensor(scene.sensors.front());
  const double away = first.sheet.signed_distance(first.world_from_camera.translation) > 0 ? -1 : 1;
  const Vector3d y = Vector3d::UnitZ().cross(away * first.sheet.normal);
  const Vector3d axis = scene.wheel.axis.normalized();
  return axis.dot(y) < 0 ? Vector3d(-axis) : axis;
}

Rigid3 rig_from_world(const Rig& rig, const std::vector<SimulatedSensor>& sensors) {
  return rig.sensors.front().rig_from_camera * sensors.front().world_from_camera.inverse();
}

RayGrid make_ray_grid(const SimulatedSensor& sensor, int margin) {
  RayGrid grid;
  grid.margin = margin;
  grid.width = sensor.camera.width + 2 * margin;
  grid.height = sensor.camera.height + 2 * margin;
  grid.directions.reserve(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  const Eigen::Matrix3d R = sensor.world_from_camera.rotation.toRotationMatrix();
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const std::optional<Vector3d> ray = unproject(sensor.camera, Vector2d(x - margin, y - margin));
      grid.directions.push_back(ray ? Vector3d(R * *ray) : Vector3d::Zero());
    }
  return grid;
}

Vector3d RayGrid::between(double x, double y) const {
  const int column = std::clamp(static_cast<int>(std::floor(x)), 0, width - 2);
  const int row = std::clamp(static_cast<int>(std::floor(y)), 0, height - 2);
  const double fx = x - column, fy = y - row;
  return (1 - fy) * ((1 - fx) * at(column, row) + fx * at(column + 1, row)) +
         fy * ((1 - fx) * at(column, row + 1) + fx * at(column + 1, row + 1));
}

std::optional<Vector2d> pixel_of(const View& view, const Vector3d& p_world) {
  const Camera& camera = view.sensor->camera;
  std::optional<Vector2d> pixel =
      project(camera, view.sensor->world_from_camera.inverse() * (view.moved.inverse() * p_world));
  if (!pixel || pixel->x() < 0 || pixel->y() < 0 || pixel->x() > camera.width - 1 ||
      pixel->y() > camera.height - 1)
    return std::nullopt;
  return pixel;
}

}  // namespace lightstripe
