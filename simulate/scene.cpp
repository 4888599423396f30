// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/scene.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/error.h"
#include "io/yaml_binding.h"
#include "simulate/optics.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

/// Throws Errors whose subject begins with where the scene comes from.
struct Rules {
  std::string origin;

  void require(bool holds, const std::string& field, const std::string& rule) const {
    if (!holds) throw Error(origin + field, "is out of range", rule);
  }
};

bool parallel(const Vector3d& a, const Vector3d& b) {
  return a.cross(b).norm() <= 1e-6 * a.norm() * b.norm();
}

bool names_a_folder(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

void check_laser(const LaserSheet& laser, const std::string& name, const Rules& rules) {
  rules.require(!parallel(laser.normal, laser.aim - laser.source), name + ".normal",
                "must not be parallel to aim - source");
  rules.require(laser.thickness_sigma_mm > 0, name + ".thickness_sigma_mm", "must be positive");
  rules.require(laser.brightness >= 0, name + ".brightness", "must not be negative");
  rules.require(laser.fan_deg > 0 && laser.fan_deg < 180, name + ".fan_deg", "must lie between 0 and 180");
}

void check_sensor(const SceneSensor& sensor, const std::string& name, const Rules& rules) {
  rules.require(names_a_folder(sensor.name), name + ".name",
                "letters, digits, - and _ only: it names a folder");
  rules.require(!parallel(sensor.target - sensor.position, sensor.up), name + ".up",
                "must not be parallel to the line of sight");
  for (const int size : sensor.image_size)
    rules.require(size >= 16 && size <= 16384, name + ".image_size", "16 to 16384 px");
  for (const double f : sensor.focal_px) rules.require(f > 0, name + ".focal_px", "must be positive");
  const std::set<std::size_t> terms{0, 4, 5, 8, 12, 14};
  rules.require(terms.count(sensor.distortion.size()) == 1, name + ".distortion",
                "give 4, 5, 8, 12 or 14 coefficients");
  check_laser(sensor.laser, name + ".laser", rules);
  rules.require(invertible_over_image(make_sensor(sensor).camera), name + ".distortion",
                "must be invertible over the whole image: give smaller coefficients");
}

void check_sensors(const Scene& scene, const Rules& rules) {
  rules.require(!scene.sensors.empty(), "sensors", "give at least one");
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    const SceneSensor& sensor = scene.sensors[i];
    check_sensor(sensor, "sensors." + std::to_string(i), rules);
    if (!names.insert(sensor.name).second)
      throw Error(rules.origin + "sensors", "two are called " + sensor.name, "rename one");
  }
  if (!scene.motion.sensor.empty() && names.count(scene.motion.sensor) == 0)
    throw Error(rules.origin + "motion.sensor", "there is no sensor " + scene.motion.sensor,
                "name one of the sensors, or leave it empty");
}

void check_imaging(const Imaging& o, const Rules& rules) {
  for (const double level :
       {o.board_ambient, o.laser_ambient, o.single_ambient, o.scan_ambient, o.dark_level})
    rules.require(level >= 0, "imaging", "levels must not be negative");
  rules.require(o.single_laser >= 0, "imaging.single_laser", "must not be negative");
  rules.require(o.light.norm() > 0, "imaging.light", "must not be zero");
  rules.require(o.exposure > 0, "imaging.exposure", "must be positive");
  rules.require(o.blur_sigma_px >= 0 && o.blur_sigma_px <= 20, "imaging.blur_sigma_px", "0 to 20");
  rules.require(o.read_noise >= 0, "imaging.read_noise", "must not be negative");
  rules.require(o.electrons_per_level >= 0, "imaging.electrons_per_level", "must not be negative");
  const bool power_of_two = o.samples > 0 && (o.samples & (o.samples - 1)) == 0;
  rules.require(power_of_two && o.samples != 2 && o.samples <= 4096, "imaging.samples",
                "1, 4, 8, 16, ... 4096");
  rules.require(o.speckle.contrast >= 0 && o.speckle.contrast <= 1, "imaging.speckle.contrast", "0 to 1");
  rules.require(o.speckle.contrast == 0 || o.speckle.contrast >= 0.05, "imaging.speckle.contrast",
                "0, or 0.05 to 1: less takes too many looks to draw and no camera shows it");
  rules.require(o.speckle.grain_px >= 0.3 && o.speckle.grain_px <= 20, "imaging.speckle.grain_px",
                "0.3 to 20");
  rules.require(o.colour.crosstalk >= 0 && o.colour.crosstalk <= 1, "imaging.colour.crosstalk", "0 to 1");
}

void check_material(const Material& o, const std::string& name, const Rules& rules) {
  rules.require(o.texture.contrast >= 0 && o.texture.contrast <= 1, name + ".material.texture.contrast",
                "0 to 1");
  rules.require(o.texture.grain_mm > 0, name + ".material.texture.grain_mm", "must be positive");
  rules.require(o.glow.share >= 0, name + ".material.glow.share", "must not be negative");
  rules.require(o.glow.reach_mm > 0, name + ".material.glow.reach_mm", "must be positive");
}

void check_materials(const Scene& o, const Rules& rules) {
  check_material(o.rail.material, "rail", rules);
  check_material(o.other_rail.material, "other_rail", rules);
  check_material(o.wheel.material, "wheel", rules);
  for (const StepsObject& steps : o.steps) check_material(steps.material, "steps", rules);
  for (const SphereObject& sphere : o.spheres) check_material(sphere.material, "spheres", rules);
  for (const CylinderObject& object : o.cylinders) check_material(object.material, "cylinders", rules);
  if (o.ground) check_material(o.ground->material, "ground", rules);
}

void check_boards(const BoardPlan& o, const Rules& rules) {
  rules.require(o.count >= 0 && o.count <= 999, "boards.count", "0 to 999");
  for (const int n : o.inner_corners) rules.require(n >= 2 && n <= 200, "boards.inner_corners", "2 to 200");
  for (const double size : o.square_mm) rules.require(size > 0, "boards.square_mm", "must be positive");
  rules.require(o.quiet_border_mm >= 0, "boards.quiet_border_mm", "must not be negative");
  rules.require(o.cut_off >= 0 && o.cut_off <= o.count, "boards.cut_off", "0 to boards.count");
  rules.require(o.max_tilt_deg >= 0 && o.max_tilt_deg < 90, "boards.max_tilt_deg", "0 to 90");
}

void check_plans(const Scene& o, const Rules& rules) {
  const int positions = o.motion.positions;
  rules.require(positions == 0 || (positions >= 2 && positions <= 999), "motion.positions", "0, or 2 to 999");
  rules.require(positions == 0 || o.turns() || o.motion.step_mm != 0, "motion.step_mm", "must not be 0");
  rules.require(positions == 0 || !o.turns() || o.motion.step_deg != 0, "motion.step_deg", "must not be 0");
  rules.require(!o.turns() || !o.has_poses(), "scan: sway", "goes with a rig that travels, not with a wheel");
  rules.require(o.scan.frames >= 0 && o.scan.frames <= 9999, "scan.frames", "0 to 9999");
  rules.require(o.scan.truth_spacing_mm > 0, "scan.truth_spacing_mm", "must be positive");
  rules.require(o.reflections.per_frame >= 0, "reflections.per_frame", "must not be negative");
  rules.require(o.reflections.edge_px > 0, "reflections.edge_px", "must be positive");
}

void check_objects(const Scene& o, const Rules& rules) {
  for (const RailObject* rail : {&o.rail, &o.other_rail})
    for (const auto& wear : {rail->vertical_wear_mm, rail->side_wear_mm})
      for (const double end : wear)
        rules.require(end >= 0, rail == &o.rail ? "rail: wear" : "other_rail: wear", "must not be negative");
  rules.require(!o.other_rail.present() || o.rail.present(), "other_rail.profile",
                "must be none where there is no rail");
  if (o.wheel.present()) {
    rules.require(!o.rail.present(), "rail.profile", "must be none where there is a wheel");
    rules.require(!parallel(o.wheel.axis, Vector3d::UnitZ()), "wheel.axis",
                  "must be neither zero nor upright");
    rules.require(o.wheel.diameter_mm >= 200, "wheel.diameter_mm", "must be 200 or more");
    rules.require(o.wheel.flange_wear_mm >= 0 && o.wheel.tread_wear_mm >= 0, "wheel: wear",
                  "must not be negative");
  }
  for (const StepsObject& steps : o.steps) {
    rules.require(!steps.heights_mm.empty(), "steps.heights_mm", "give at least one");
    for (const double height : steps.heights_mm)
      rules.require(height > 0, "steps.heights_mm", "must be positive");
    rules.require(steps.run_mm > 0 && steps.length_mm > 0, "steps", "run_mm and length_mm must be positive");
  }
  for (const SphereObject& sphere : o.spheres)
    rules.require(sphere.radius_mm > 0, "spheres.radius_mm", "must be positive");
  for (const CylinderObject& object : o.cylinders)
    rules.require(object.radius_mm > 0 && object.length_mm > 0 && object.axis.norm() > 0, "cylinders",
                  "radius_mm, length_mm and the axis' length must be positive");
}

}  // namespace

std::vector<SceneSensor> two_sensor_rail_rig() {
  SceneSensor gauge, field;
  field.name = "field";
  field.position = {-355.0, -306.0, 224.0};
  field.target = {0.0, -12.0, -74.0};
  field.focal_px = {1638.9, 1637.6};
  field.principal_point_px = {473.5, 352.4};
  field.distortion = {-0.087, 0.104, -0.0006, 0.0004, -0.037};
  field.laser.source = {-1.5, -262.0, 243.0};
  field.laser.aim = {0.5, -10.0, -75.0};
  field.laser.normal = {1.0, -0.003, 0.0};
  return {gauge, field};
}

Scene wheel_scene() {
  Scene scene;
  scene.seed = 11;
  scene.motion.positions = 11;
  scene.motion.step_deg = 1.8;
  scene.motion.moves = Moves::kObject;
  scene.scan.frames = 36;
  scene.scan.step_deg = 10;
  scene.rail.profile = "none";
  scene.wheel.profile = "S1002";
  scene.wheel.center = {0, 0, -530};
  scene.wheel.axis = {0, -1, 0};
  scene.wheel.flange_wear_mm = 2;
  scene.wheel.tread_wear_mm = 1.5;
  scene.wheel.eccentricity_mm = 0.15;
  scene.wheel.material = {0.55, 0.1, 20};
  return scene;
}

void Scene::check(const std::string& origin) const {
  const Rules rules{origin.empty() ? "" : origin + ": "};
  check_sensors(*this, rules);
  check_imaging(imaging, rules);
  check_boards(boards, rules);
  check_plans(*this, rules);
  check_objects(*this, rules);
  check_materials(*this, rules);
}

Scene read_scene(const std::filesystem::path& path) {
  Scene scene;
  read_yaml(path, scene);
  for (std::string* profile : {&scene.rail.profile, &scene.other_rail.profile, &scene.wheel.profile})
    if (profile->ends_with(".yaml")) *profile = (path.parent_path() / *profile).string();
  scene.check(path.string());
  return scene;
}

}  // namespace lightstripe
