// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/rig_file.h"

#include <gmock/gmock.h>

#include <limits>

#include "core/random.h"
#include "tests/io/temp_folder.h"

namespace lightstripe {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Eigen::Vector3d random_vector(Random& random) {
  return {random.gaussian(), random.gaussian(), random.gaussian()};
}

Sensor random_sensor(const std::string& name, Random& random) {
  Sensor sensor;
  sensor.name = name;
  sensor.camera.width = 960;
  sensor.camera.height = 700;
  sensor.camera.fx = 1640 + random.gaussian();
  sensor.camera.fy = 1640 + random.gaussian();
  sensor.camera.cx = 480 + random.gaussian();
  sensor.camera.cy = 350 + random.gaussian();
  sensor.camera.distortion = {-0.1 + 0.01 * random.gaussian(), 0.05, 1e-4 * random.gaussian(), -1e-4, 0.01};
  for (int i = 0; i < 2; ++i)
    sensor.laser_planes.push_back({random_vector(random).normalized(), 100 + random.uniform()});
  sensor.rig_from_camera.rotation =
      Eigen::Quaterniond(random.gaussian(), random.gaussian(), random.gaussian(), random.gaussian())
          .normalized();
  sensor.rig_from_camera.translation = 300 * random_vector(random);
  return sensor;
}

Rig random_rig(std::uint64_t seed) {
  Random random(seed);
  Rig rig;
  rig.sensors = {random_sensor("gauge", random), random_sensor("field", random)};
  rig.motion.type = MotionType::kLinear;
  rig.motion.direction = random_vector(random).normalized();
  rig.motion.moves = Moves::kObject;
  rig.quality.sensors = {{"gauge", 0.0812345, 0.05, 20, 19}};
  rig.quality.sigma = {{"gauge.camera.fx", 0.123456789}, {"field.plane.0.offset", 0.01}};
  rig.quality.section_shape_sigma_mm = 0.007;
  rig.quality.section_bends = SectionBends{{-310, 25}, 100, {std::vector<double>(24, 0.001234)}};
  rig.quality.warnings = {"few boards: tilt them more", "x"};
  return rig;
}

void expect_same(const Sensor& a, const Sensor& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.camera.width, b.camera.width);
  EXPECT_EQ(a.camera.height, b.camera.height);
  EXPECT_EQ(a.camera.fx, b.camera.fx);
  EXPECT_EQ(a.camera.fy, b.camera.fy);
  EXPECT_EQ(a.camera.cx, b.camera.cx);
  EXPECT_EQ(a.camera.cy, b.camera.cy);
  EXPECT_EQ(a.camera.distortion, b.camera.distortion);
  ASSERT_EQ(a.laser_planes.size(), b.laser_planes.size());
  for (std::size_t i = 0; i < a.laser_planes.size(); ++i) {
    // A unit vector to the last bit or two may be divided by its length once more; it never gets worse.
    EXPECT_LT((a.laser_planes[i].normal - b.laser_planes[i].normal).norm(), 1e-15);
    EXPECT_NEAR(a.laser_planes[i].offset, b.laser_planes[i].offset, 1e-13);
  }
  EXPECT_LT((a.rig_from_camera.rotation.coeffs() - b.rig_from_camera.rotation.coeffs()).norm(), 1e-15);
  EXPECT_EQ(a.rig_from_camera.translation, b.rig_from_camera.translation);
}

TEST(RigFile, ReadsBackWhatWasWritten) {
  const TempFolder folder;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Rig before = random_rig(seed);
    const std::string text = rig_to_yaml(before);
    const Rig after = read_rig(folder.write("rig.yaml", text));
    ASSERT_EQ(after.sensors.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) expect_same(after.sensors[i], before.sensors[i]);
    EXPECT_EQ(after.motion.type, MotionType::kLinear);
    EXPECT_LT((after.motion.direction - before.motion.direction).norm(), 1e-15);
    EXPECT_EQ(after.motion.moves, Moves::kObject);
    EXPECT_EQ(after.quality.sensors[0].board_rms_px, 0.0812345);
    EXPECT_EQ(after.quality.sensors[0].stripe_views, 19);
    EXPECT_EQ(after.quality.sigma, before.quality.sigma);
    EXPECT_EQ(after.quality.section_shape_sigma_mm, 0.007);
    ASSERT_TRUE(after.quality.section_bends);
    EXPECT_EQ(after.quality.section_bends->centre_mm, before.quality.section_bends->centre_mm);
    EXPECT_EQ(after.quality.section_bends->bends, before.quality.section_bends->bends);
    EXPECT_THAT(after.quality.warnings, ElementsAre("few boards: tilt them more", "x"));
    EXPECT_EQ(rig_to_yaml(after), text) << "bits changed on the way";
  }
}

TEST(RigFile, KeepsARotaryMotionAndAMissingOne) {
  const TempFolder folder;
  Rig rig = random_rig(1);
  rig.motion = {};
  EXPECT_EQ(read_rig(folder.write("rig.yaml", rig_to_yaml(rig))).motion.type, MotionType::kNone);
  rig.motion.type = MotionType::kRotary;
  rig.motion.axis_point = {1, 2, 3};
  rig.motion.axis_direction = {0, 0.6, 0.8};
  const Motion motion = read_rig(folder.write("rig.yaml", rig_to_yaml(rig))).motion;
  EXPECT_EQ(motion.type, MotionType::kRotary);
  EXPECT_EQ(motion.axis_point, Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((motion.axis_direction - rig.motion.axis_direction).norm(), 1e-15);
  EXPECT_EQ(motion.moves, Moves::kRig);
}

TEST(RigFile, WritesAsManyDistortionTermsAsItTakes) {
  const auto terms_with = [](int last) {
    Rig rig = random_rig(2);
    rig.sensors.resize(1);
    if (last >= 0) rig.sensors[0].camera.distortion.at(static_cast<std::size_t>(last)) = 1e-3;
    const std::string text = rig_to_yaml(rig);
    const std::size_t start = text.find("distortion: ["), end = text.find(']', start);
    return 1 + std::count(text.begin() + static_cast<std::ptrdiff_t>(start),
                          text.begin() + static_cast<std::ptrdiff_t>(end), ',');
  };
  EXPECT_EQ(terms_with(-1), 5);
  EXPECT_EQ(terms_with(5), 8);
  EXPECT_EQ(terms_with(7), 8);
  EXPECT_EQ(terms_with(8), 12);
  EXPECT_EQ(terms_with(13), 14);
}

constexpr const char* kByHand = R"(format: lightstripe-rig/1
sensors:
  - name: gauge
    image_size: [1152, 768]
    camera: {fx: 819.58, fy: 820.87, cx: 589.73, cy: 355.78, distortion: [0.0981, -0.1825, -0.0077, 0.00015]}
    laser_planes:
      - {normal: [-0.873570, -0.350300, 0.337880], offset: 123.309}
    rig_from_camera: {rotation: [1, 0, 0, 0], translation: [0, 0, 0]}
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Rig read(const std::string& text) {
  const TempFolder folder;
  return read_rig(folder.write("rig.yaml", text));
}

std::string complaint(const std::string& from, const std::string& to) {
  const std::string message = error_of([&] { read(with(kByHand, from, to)); });
  return message.substr(std::min(message.find("rig.yaml"), message.size()));
}

TEST(RigFile, MakesRoundedUnitVectorsExactWithoutMovingThePlane) {
  const Rig rig = read(kByHand);
  const Plane& plane = rig.sensors[0].laser_planes[0];
  EXPECT_NEAR(plane.normal.norm(), 1, 1e-15);
  // A point of the plane as it is written stays on it: n.X = d is divided by |n| on both sides.
  const Eigen::Vector3d n(-0.873570, -0.350300, 0.337880);
  const Eigen::Vector3d on_plane = n * (123.309 / n.squaredNorm());
  EXPECT_NEAR(plane.signed_distance(on_plane), 0, 1e-12);
  EXPECT_EQ(rig.sensors[0].camera.distortion[3], 0.00015);
  EXPECT_EQ(rig.motion.type, MotionType::kNone);
}

TEST(RigFile, TakesAnyQuality) {
  EXPECT_NO_THROW(read(std::string(kByHand) + "quality: {}\n"));
  EXPECT_NO_THROW(read(std::string(kByHand) + "quality: unknown\n"));
  EXPECT_NO_THROW(read(std::string(kByHand) + "quality:\n"));
  const Rig rig =
      read(std::string(kByHand) +
           "quality: {rms_px: 0.1, sensors: good, warnings: [a], sigma: {x: 1}, nested: {a: [1, {b: c}]}}\n");
  EXPECT_TRUE(rig.quality.sensors.empty());
  EXPECT_THAT(rig.quality.warnings, ElementsAre("a"));
  EXPECT_EQ(rig.quality.sigma.at("x"), 1);
}

TEST(RigFile, LeavesOutSigmasThatAreNotFinite) {
  Rig rig = random_rig(3);
  rig.quality.sigma["gauge.camera.k3"] = std::numeric_limits<double>::quiet_NaN();
  rig.quality.section_absolute_sigma_mm = std::numeric_limits<double>::infinity();
  const Rig after = read(rig_to_yaml(rig));
  EXPECT_EQ(after.quality.sigma.size(), 2U);
  EXPECT_EQ(after.quality.section_absolute_sigma_mm, 0);
}

TEST(RigFile, NamesFileAndKeyOfWhatIsWrong) {
  EXPECT_THAT(complaint("rig/1", "rig/2"), HasSubstr("rig.yaml: format: is not lightstripe-rig/1"));
  EXPECT_THAT(complaint("format: lightstripe-rig/1\n", ""), HasSubstr("rig.yaml: format: is missing"));
  EXPECT_THAT(complaint("fx: 819.58", "fx: .nan"), HasSubstr("sensors[0].camera.fx (line 5): is '.nan'"));
  EXPECT_THAT(complaint("fx: 819.58", "fx: 0"), HasSubstr("sensors[0].camera.fx: is not positive"));
  EXPECT_THAT(complaint("fy: 820.87, ", ""), HasSubstr("sensors[0].camera.fy: is missing"));
  EXPECT_THAT(complaint(", 0.00015]", "]"),
              HasSubstr("camera.distortion: has a number of terms that no model has"));
  EXPECT_THAT(complaint("[0.0981,", "[-5,"), HasSubstr("camera.distortion: folds over inside the image"));
  EXPECT_THAT(complaint("[1152, 768]", "[0, 768]"), HasSubstr("sensors[0].image_size: is out of range"));
  EXPECT_THAT(complaint("-0.873570", "-0.9"), HasSubstr("laser_planes[0].normal: has not unit length"));
  EXPECT_THAT(complaint("offset: 123.309", "offset: -123.309"),
              HasSubstr("laser_planes[0].offset: is not positive"));
  EXPECT_THAT(complaint("[1, 0, 0, 0]", "[1, 1, 0, 0]"),
              HasSubstr("rig_from_camera.rotation: has not unit length"));
  EXPECT_THAT(complaint("[1, 0, 0, 0]", "[0, 0, 0, 0]"),
              HasSubstr("rig_from_camera.rotation: has not unit length"));
  EXPECT_THAT(complaint("name: gauge", "name: ''"), HasSubstr("sensors[0].name: is empty"));
  EXPECT_THAT(complaint("translation", "translatoin"), HasSubstr("did you mean 'translation'?"));
}

TEST(RigFile, NamesWhatIsWrongWithTheMotion) {
  const auto motion_complaint = [](const std::string& motion) {
    return error_of([&] { read(std::string(kByHand) + "motion: " + motion + "\n"); });
  };
  EXPECT_EQ(motion_complaint("{type: linear, direction: [1, 0, 0]}"), "no Error");
  EXPECT_THAT(motion_complaint("{type: linear}"), HasSubstr("motion.direction: is missing"));
  EXPECT_THAT(motion_complaint("{type: linear, direction: [1, 1, 0]}"),
              HasSubstr("motion.direction: has not unit length"));
  EXPECT_THAT(motion_complaint("{type: rotary, axis_point: [0, 0, 0]}"),
              HasSubstr("motion.axis_direction: is missing"));
  EXPECT_THAT(motion_complaint("{type: rotary, direction: [1, 0, 0]}"), HasSubstr("motion: mixes the keys"));
  EXPECT_THAT(motion_complaint("{type: none}"), HasSubstr("allowed: linear, rotary"));
}

}  // namespace
}  // namespace lightstripe
