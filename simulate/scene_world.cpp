// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/scene_world.h"

#include "core/transform.h"
#include "io/nominal_outlines.h"
#include "simulate/worn_rail.h"
#include "simulate/worn_wheel.h"

namespace lightstripe {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// u -> -u; closed and counterclockwise as before.
Outline mirror_image(const Outline& outline) {
  Outline out = reversed(outline);
  for (OutlineSegment& segment : out.segments) {
    for (Vector2d* point : {&segment.from, &segment.to, &segment.center}) point->x() = -point->x();
    segment.counterclockwise = !segment.counterclockwise;
  }
  return out;
}

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

RailWear wear_at(const RailObject& rail, const ScanPlan& scan, int frame) {
  const double share = scan.frames > 1 ? static_cast<double>(frame) / (scan.frames - 1) : 0;
  const auto between = [share](const std::array<double, 2>& ends) {
    return ends[0] + share * (ends[1] - ends[0]);
  };
  return {between(rail.vertical_wear_mm), between(rail.side_wear_mm)};
}

Outline rail_outline(const RailObject& rail, const ScanPlan& scan, const Outline& nominal, int frame) {
  const RailWear wear = wear_at(rail, scan, frame);
  const Outline worn = worn_rail(nominal, wear.vertical_mm, wear.side_mm);
  return rail.gauge_side == WornFace::kLeft ? worn : mirror_image(worn);
}

Rigid3 world_from_rail(const RailObject& rail) {
  return {Quaterniond(AngleAxisd(rail.inclination_deg * kDegree, Vector3d::UnitX())), rail.top};
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

NominalOutlines nominal_outlines(const Scene& scene) {
  NominalOutlines out;
  if (scene.rail.present()) out.main = read_nominal(scene.rail.profile);
  if (scene.wheel.present()) out.main = read_nominal(scene.wheel.profile);
  if (scene.other_rail.present()) out.other_rail = read_nominal(scene.other_rail.profile);
  return out;
}

World scan_world(const Scene& scene, const NominalOutlines& nominal, int frame) {
  World world;
  const auto add_rail = [&](const RailObject& rail, const Outline& unworn) {
    if (rail.present())
      world.extrusions.push_back(make_extrusion(
          world_from_rail(rail), rail_outline(rail, scene.scan, unworn, frame), 0, rail.material));
  };
  add_rail(scene.rail, nominal.main);
  add_rail(scene.other_rail, nominal.other_rail);
  if (scene.wheel.present())
    world.revolutions.push_back(make_revolution(world_from_wheel(scene), wheel_outline(scene, nominal.main),
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
  const auto one_section = [](const RailObject& rail) {
    return !rail.present() || (rail.vertical_wear_mm[0] == rail.vertical_wear_mm[1] &&
                               rail.side_wear_mm[0] == rail.side_wear_mm[1]);
  };
  return endless && one_section(scene.rail) && one_section(scene.other_rail);
}

}  // namespace lightstripe
