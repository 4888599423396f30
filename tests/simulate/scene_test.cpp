// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/scene.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/error.h"
#include "io/yaml_binding.h"
#include "simulate/optics.h"
#include "test_paths.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using ::testing::HasSubstr;

fs::path written(const std::string& text) {
  const fs::path path = fs::temp_directory_path() / "lightstripe_scene_test.yaml";
  std::ofstream(path) << text;
  return path;
}

std::string message_of(const std::string& text) {
  try {
    read_scene(written(text));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneFile, KeysLeftOutKeepTheDefaults) {
  const Scene scene = read_scene(written("seed: 9\nscan: {frames: 3}\n"));
  EXPECT_EQ(scene.seed, 9);
  EXPECT_EQ(scene.scan.frames, 3);
  EXPECT_EQ(scene.scan.step_mm, Scene().scan.step_mm);
  ASSERT_EQ(scene.sensors.size(), 2U);
  EXPECT_EQ(scene.sensors[1].name, "field");
}

TEST(SceneFile, OutlineFileIsRelativeToTheScenesFolder) {
  const fs::path folder = fs::temp_directory_path();
  EXPECT_EQ(read_scene(written("rail: {profile: rails/mine.yaml}\n")).rail.profile,
            (folder / "rails/mine.yaml").string());
  EXPECT_EQ(read_scene(written("rail: {profile: /rails/mine.yaml}\n")).rail.profile, "/rails/mine.yaml");
  EXPECT_EQ(read_scene(written("rail: {profile: 60E1}\n")).rail.profile, "60E1");
}

TEST(SceneFile, DumpReadsBackToTheSameScene) {
  Scene scene;
  scene.steps.emplace_back();
  scene.cylinders.emplace_back();
  scene.ground = GroundObject{-3, {}};
  const std::string text = dump_yaml(scene);
  EXPECT_EQ(dump_yaml(read_scene(written(text))), text);
  EXPECT_EQ(dump_yaml(read_scene(written(dump_yaml(scene, true)))), text);
}

TEST(SceneFile, BadValuesAreRefusedByName) {
  EXPECT_THAT(message_of("sensors: []\n"), HasSubstr("scene_test.yaml: sensors: "));
  EXPECT_THAT(message_of("sensors: [{name: a}, {name: a}]\n"), HasSubstr("two are called a"));
  EXPECT_THAT(message_of("sensors: [{name: ../a}]\n"), HasSubstr("sensors.0.name"));
  EXPECT_THAT(message_of("sensors: [{focal_px: [0, 1]}]\n"), HasSubstr("sensors.0.focal_px"));
  EXPECT_THAT(message_of("sensors: [{up: [353, -297, -297]}]\n"), HasSubstr("sensors.0.up"));
  EXPECT_THAT(message_of("sensors: [{distortion: [1, 2]}]\n"), HasSubstr("sensors.0.distortion"));
  EXPECT_THAT(message_of("sensors: [{distortion: [-9, 0, 0, 0]}]\n"), HasSubstr("invertible"));
  EXPECT_THAT(message_of("imaging: {samples: 6}\n"), HasSubstr("imaging.samples"));
  EXPECT_THAT(message_of("motion: {sensor: roof}\n"), HasSubstr("no sensor roof"));
  EXPECT_THAT(message_of("motion: {positions: 1}\n"), HasSubstr("motion.positions"));
  EXPECT_THAT(message_of("rail: {side_wear_mm: [0, -1]}\n"), HasSubstr("rail: wear"));
  EXPECT_THAT(message_of("scan: {speed: 3}\n"), HasSubstr("speed"));
}

TEST(SceneFile, EveryExampleIsValid) {
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(std::string(LIGHTSTRIPE_SOURCE_DIR) + "/configs/scenes")) {
    EXPECT_NO_THROW(read_scene(entry.path())) << entry.path();
    ++examples;
  }
  EXPECT_GE(examples, 3);
}

TEST(SceneFile, DemoExampleIsTheDefaultScene) {
  const Scene scene = read_scene(std::string(LIGHTSTRIPE_SOURCE_DIR) + "/configs/scenes/demo.yaml");
  EXPECT_EQ(dump_yaml(scene), dump_yaml(Scene()));
}

TEST(TrueRig, HasTheFrameOfTheContract) {
  const Scene scene;
  const auto sensors = make_sensors(scene);
  const Rig rig = true_rig(scene, sensors);
  const Rigid3 to_rig = rig_from_world(rig, sensors);
  EXPECT_NEAR((to_rig * scene.sensors[0].position).norm(), 0, 1e-9);  // origin: first projection centre
  EXPECT_NEAR((to_rig.rotation * Vector3d::UnitX() - Vector3d::UnitX()).norm(), 0, 1e-12);  // x: travel
  EXPECT_NEAR((to_rig.rotation * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 0, 1e-12);  // z: up
  const Vector3d second = rig.sensors[1].rig_from_camera.translation;
  EXPECT_NEAR((second - (scene.sensors[1].position - scene.sensors[0].position)).norm(), 0, 1e-9);
}

TEST(TrueRig, LaserPlanesHoldSourceAndAimInTheCamerasFrame) {
  const Scene scene;
  const auto sensors = make_sensors(scene);
  const Rig rig = true_rig(scene, sensors);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const Plane& plane = rig.sensors[i].laser_planes.at(0);
    const Rigid3 camera_from_world = sensors[i].world_from_camera.inverse();
    EXPECT_GT(plane.offset, 0);
    EXPECT_NEAR(plane.signed_distance(camera_from_world * scene.sensors[i].laser.source), 0, 1e-9);
    EXPECT_NEAR(plane.signed_distance(camera_from_world * scene.sensors[i].laser.aim), 0, 1e-9);
  }
}

TEST(TrueRig, DefaultRigIsTheOneOfTheFigures) {
  for (const SceneSensor& sensor : two_sensor_rail_rig()) {
    const SimulatedSensor made = make_sensor(sensor);
    const Vector3d sight = sensor.target - sensor.position;
    EXPECT_NEAR(sight.norm(), 550, 10);
    const double triangulation =
        std::asin(std::abs(sight.normalized().dot(made.sheet.normal))) * 180 / std::numbers::pi;
    EXPECT_NEAR(triangulation, 40, 5);
    EXPECT_GT(std::abs(made.sheet.normal.x()),
              std::cos(std::numbers::pi / 180));  // within a degree across the rail
  }
}

TEST(TrueRig, WithoutMotionXIsTheFirstLasersNormalAwayFromTheCamera) {
  Scene scene;
  scene.motion.positions = 0;
  const auto sensors = make_sensors(scene);
  const Rig rig = true_rig(scene, sensors);
  EXPECT_EQ(rig.motion.type, MotionType::kNone);
  const Vector3d x_cam = rig.sensors[0].rig_from_camera.rotation.conjugate() * Vector3d::UnitX();
  EXPECT_NEAR((x_cam - rig.sensors[0].laser_planes[0].normal).norm(), 0, 1e-12);
}

TEST(Scene, TheBuiltInWheelIsThatOfTheExampleFile) {
  EXPECT_EQ(dump_yaml(wheel_scene()),
            dump_yaml(read_scene(LIGHTSTRIPE_SOURCE_DIR "/configs/scenes/wheel.yaml")));
}

TEST(Scene, AWheelStandsAloneAndItsAxisLiesLevel) {
  Scene scene = wheel_scene();
  scene.rail.profile = "60E1";
  EXPECT_THROW(scene.check(), Error);
  scene = wheel_scene();
  scene.wheel.axis = {0, 0, 1};
  EXPECT_THROW(scene.check(), Error);
  scene = wheel_scene();
  scene.scan.sway_deg = 1;
  EXPECT_THROW(scene.check(), Error);
}

}  // namespace
}  // namespace lightstripe
