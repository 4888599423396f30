// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/scene_world.h"

#include <numbers>

#include "simulate/worn_rail.h"
#include "simulate/worn_wheel.h"

namespace lightstripe {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

Extrusion staircase(const StepsObject& steps) {
  const double half = 0.5 * steps.run_mm * static_cast<double>(steps.heights_mm.size());
  std::vector<Vector2d> corners{{half, 0}, {-half, 0}};
  for (std::size_t i = 0; i < steps.heights_mm.size(); ++i) {
    const double left = -half + steps.run_mm * static_cast<double>(i);
    corners.push_back({left, steps.heights_mm[i]});
    corners.push_back({left + steps.run_mm, steps.heights_mm[i]});
  }
  const Quaterniond turned(AngleAxisd(steps.yaw_deg * kDegree, Vector3d::UnitZ()));
  return make_extrusion({turned, steps.base}, polygon_outline(corners), steps.length_mm, steps.material);
}

Extrusion cylinder(const CylinderObject& object) {
  const Quaterniond turned = Quaterniond::FromTwoVectors(Vector3d::UnitX(), object.axis);
  return make_extrusion({turned, object.center}, circle_outline(object.radius_mm), object.length_mm,
                        object.material);
}

}  // namespace

RailWear wear_at(const Scene& scene, int frame) {
  const double share = scene.scan.frames > 1 ? static_cast<double>(frame) / (scene.scan.frames - 1) : 0;
  const auto between = [share](const std::array<double, 2>& ends) {
    return ends[0] + share * (ends[1] - ends[0]);
  };
  return {between(scene.rail.vertical_wear_mm), between(scene.rail.side_wear_mm)};
}

Outline rail_outline(const Scene& scene, const Outline& nominal, int frame) {
  const RailWear wear = wear_at(scene, frame);
  return worn_rail(nominal, wear.vertical_mm, wear.side_mm);
}

Rigid3 world_from_rail(const Scene& scene) {
  return {Quaterniond(AngleAxisd(scene.rail.inclination_deg * kDegree, Vector3d::UnitX())), scene.rail.top};
}

Outline wheel_outline(const Scene& scene, const Outline& nominal) {
  return worn_wheel(nominal, {scene.wheel.flange_wear_mm, scene.wheel.tread_wear_mm});
}

Rigid3 world_from_wheel(const Scene& scene) {
  const Vector3d axis = scene.wheel.axis.normalized();
  const Vector3d up = (Vector3d::UnitZ() - axis.z() * axis).normalized();
  return {Quaterniond::FromTwoVectors(Vector3d::UnitX(), axis),
          scene.wheel.center + scene.wheel.eccentricity_mm * up};
}

World scan_world(const Scene& scene, const Outline& nominal, int frame) {
  World world;
  if (scene.rail.present())
    world.extrusions.push_back(
        make_extrusion(world_from_rail(scene), rail_outline(scene, nominal, frame), 0, scene.rail.material));
  if (scene.wheel.present())
    world.revolutions.push_back(make_revolution(world_from_wheel(scene), wheel_outline(scene, nominal),
                                                scene.wheel.diameter_mm / 2, scene.wheel.material));
  for (const StepsObject& steps : scene.steps) world.extrusions.push_back(staircase(steps));
  for (const CylinderObject& object : scene.cylinders) world.extrusions.push_back(cylinder(object));
  world.spheres = scene.spheres;
  world.ground = scene.ground;
  return world;
}

bool same_in_all_frames(const Scene& scene) {
  const bool endless = scene.steps.empty() && scene.spheres.empty() && scene.cylinders.empty();
  if (scene.has_poses()) return false;
  if (scene.wheel.present()) return endless && !scene.ground && scene.wheel.eccentricity_mm == 0;
  const RailObject& rail = scene.rail;
  const bool one_section =
      rail.vertical_wear_mm[0] == rail.vertical_wear_mm[1] && rail.side_wear_mm[0] == rail.side_wear_mm[1];
  return endless && (one_section || !rail.present());
}

}  // namespace lightstripe
