// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Predicted against actual errors: random rigs, observations with known noise.
#include "calib/uncertainty.h"

#include <gtest/gtest.h>

#include "calib/calibrate_rig.h"
#include "calib/initial_values.h"
#include "calib/measurements.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using testing::kDegree;

/// A calibration of a random rig with its errors, each divided by its predicted sigma.
struct Trial {
  std::map<std::string, double> normalised;
  double shape_predicted_mm = 0, shape_actual_mm = 0;
};

void compare_sensors(const Rig& rig, const testing::SyntheticRig& truth, Trial& trial) {
  const auto& sigma = rig.quality.sigma;
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    const auto &found = rig.sensors[s], &name = found;
    const auto& known = truth.sensors[s];
    const auto add = [&](const std::string& what, double error) {
      trial.normalised[name.name + what] = error / sigma.at(name.name + what);
    };
    add(".camera.fx", found.camera.fx - known.camera.fx);
    add(".camera.cx", found.camera.cx - known.camera.cx);
    add(".camera.k1", found.camera.distortion[0] - known.camera.distortion[0]);
    const Plane &a = found.laser_planes[0], &b = known.laser_planes[0];
    add(".laser_planes.0.normal_deg", std::asin(a.normal.cross(b.normal).norm()) / kDegree);
    add(".laser_planes.0.offset_mm", a.offset - b.offset);
    if (s == 0) continue;
    const Rigid3 first_from_camera = rig.sensors[0].rig_from_camera.inverse() * found.rig_from_camera;
    add(".pose.rotation_deg", rotation_angle((first_from_camera * known.cam_from_first).rotation) / kDegree);
    add(".pose.translation_mm",
        (first_from_camera.translation - known.cam_from_first.inverse().translation).norm());
  }
  const Vector3d x = rig.sensors[0].rig_from_camera.rotation.conjugate() * Vector3d::UnitX();
  trial.normalised["motion.direction_deg"] =
      std::asin(x.cross(truth.direction).norm()) / kDegree / sigma.at("motion.direction_deg");
}

/// Error of the section's shape at the stripe points of the session.
double shape_error_mm(const Rig& rig, const testing::SyntheticRig& truth,
                      const CalibrationObservations& observations) {
  RigState found, known;
  std::vector<SectionSample> samples;
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    const auto& sensor = rig.sensors[s];
    const Rigid3 cam_from_first = sensor.rig_from_camera.inverse() * rig.sensors[0].rig_from_camera;
    found.sensors.push_back({sensor.camera, cam_from_first, sensor.laser_planes});
    known.sensors.push_back(truth.sensors[s]);
    for (const auto& view : observations.sensors[s].views)
      for (std::size_t i = 0; i < view.stripes[0].size(); i += 5)
        samples.push_back({static_cast<int>(s), 0, {view.stripes[0][i].x, view.stripes[0][i].y}});
  }
  found.motion.emplace();
  found.motion->direction = rig.sensors[0].rig_from_camera.rotation.conjugate() * Vector3d::UnitX();
  known.motion.emplace();
  known.motion->direction = truth.direction;
  const Eigen::VectorXd a = section_of(found, MotionType::kLinear, {0, -1, 0}, samples);
  const Eigen::VectorXd b = section_of(known, MotionType::kLinear, {0, -1, 0}, samples);
  return (without_rigid_motion(b) * (a - b)).norm() / std::sqrt(static_cast<double>(samples.size()));
}

Trial trial(std::uint64_t seed) {
  auto truth = testing::rail_rig(2, 100 + seed);
  for (auto& sensor : truth.sensors) sensor.camera.distortion[4] = 0;
  const auto observations = testing::observe(truth, {.poses = 12, .seed = 100 + seed});
  CalibrationOptions options;
  options.lens = LensModel::kBrown4;  // the true model: the prediction knows nothing of terms left out
  const auto result = calibrate_rig(observations, options);
  EXPECT_TRUE(result.summary.usable) << result.summary.message;
  Trial trial;
  compare_sensors(result.rig, truth, trial);
  trial.shape_predicted_mm = result.rig.quality.section_shape_sigma_mm;
  trial.shape_actual_mm = shape_error_mm(result.rig, truth, observations);
  return trial;
}

TEST(PredictedErrors, AgreeWithTheActualErrorsOfRandomRigs) {
  constexpr int kTrials = 16;
  std::map<std::string, double> square;
  double predicted = 0, actual = 0;
  for (int i = 0; i < kTrials; ++i) {
    const Trial t = trial(static_cast<std::uint64_t>(i));
    for (const auto& [name, error] : t.normalised) square[name] += error * error / kTrials;
    predicted += t.shape_predicted_mm * t.shape_predicted_mm / kTrials;
    actual += t.shape_actual_mm * t.shape_actual_mm / kTrials;
  }
  // The mean of 16 squared standard normals lies in [0.32, 2.1] with 99.5 %; of the mean over all names (some
  // dozens, but dependent) the test asks more.
  double mean = 0;
  for (const auto& [name, value] : square) {
    EXPECT_GT(value, 0.3) << name;
    EXPECT_LT(value, 2.4) << name;
    mean += value / static_cast<double>(square.size());
  }
  EXPECT_NEAR(mean, 1, 0.3);
  EXPECT_NEAR(std::sqrt(actual / predicted), 1, 0.25);
}

}  // namespace
}  // namespace lightstripe
