// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Predicted against actual errors: random two-sensor rail rigs, 20 poses, corners with 0.07 px of noise,
// stripes with 0.1 px. LIGHTSTRIPE_TRIALS=100 makes the long run and prints the table of docs/method.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

#include "calib/adjust/session_views.h"
#include "calib/calibrate_rig.h"
#include "calib/start/initial_values.h"
#include "section_error.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

/// Errors of one calibration beside their predictions.
struct Trial {
  std::map<std::string, double>
      normalised;  ///< error / sigma; of vectors: length / root of the summed variances
  double shape_mm = 0, absolute_mm = 0, shape_sigma_mm = 0, absolute_sigma_mm = 0;
  double two_step_shape_mm = 0;  ///< intrinsics and poses first, then planes through the rays' meeting points
  double plane_deg = 0, plane_sigma_deg = 0, plane_mm = 0,
         plane_sigma_mm = 0;  ///< mean square over the sensors
};

void compare_sensors(const Rig& rig, const testing::SyntheticRig& truth, Trial& trial) {
  const auto& sigma = rig.quality.sigma;
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    const auto& found = rig.sensors[s];
    const auto& known = truth.sensors[s];
    const auto add = [&](const std::string& what, double error) {
      trial.normalised[found.name + what] = error / sigma.at(found.name + what);
    };
    add(".camera.fx", found.camera.fx - known.camera.fx);
    add(".camera.cx", found.camera.cx - known.camera.cx);
    add(".camera.k1", found.camera.distortion[0] - known.camera.distortion[0]);
    const Plane &a = found.laser_planes[0], &b = known.laser_planes[0];
    const double angle = std::asin(a.normal.cross(b.normal).norm()) / kDegree;
    add(".laser_planes.0.normal_deg", angle);
    add(".laser_planes.0.offset_mm", a.offset - b.offset);
    const auto square_mean = [&](double value) {
      return value * value / static_cast<double>(rig.sensors.size());
    };
    trial.plane_deg += square_mean(angle);
    trial.plane_mm += square_mean(a.offset - b.offset);
    trial.plane_sigma_deg += square_mean(sigma.at(found.name + ".laser_planes.0.normal_deg"));
    trial.plane_sigma_mm += square_mean(sigma.at(found.name + ".laser_planes.0.offset_mm"));
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

Trial trial(std::uint64_t seed) {
  auto truth = testing::rail_rig(2, 100 + seed);
  for (auto& sensor : truth.sensors) sensor.camera.distortion[4] = 0;
  const auto observations = testing::observe(truth, {.poses = 20, .seed = 100 + seed});
  CalibrationOptions options;
  options.lens = LensModel::kBrown4;  // the true model: the prediction knows nothing of terms left out
  options.board_warp = true;
  const auto result = calibrate_rig(observations, options);
  EXPECT_TRUE(result.summary.usable) << result.summary.message;
  Trial trial;
  compare_sensors(result.rig, truth, trial);
  const auto joint = testing::section_error(testing::state_of(result.rig), truth, observations);
  trial.shape_mm = joint.shape_mm;
  trial.absolute_mm = joint.absolute_mm;
  trial.shape_sigma_mm = result.rig.quality.section_shape_sigma_mm;
  trial.absolute_sigma_mm = result.rig.quality.section_absolute_sigma_mm;
  const RigState two_step = initial_values(prepare_session_views(observations)).state;
  trial.two_step_shape_mm = testing::section_error(two_step, truth, observations).shape_mm;
  return trial;
}

std::vector<Trial> trials(int count) {
  std::vector<Trial> result(static_cast<std::size_t>(count));
  std::vector<std::thread> threads;
  constexpr std::size_t kThreads = 2;
  for (std::size_t t = 0; t < kThreads; ++t)
    threads.emplace_back([&result, t] {
      for (std::size_t i = t; i < result.size(); i += kThreads) result[i] = trial(i);
    });
  for (auto& thread : threads) thread.join();
  return result;
}

double rms(const std::vector<Trial>& all, double Trial::*value) {
  double sum = 0;
  for (const auto& t : all) sum += t.*value * t.*value / static_cast<double>(all.size());
  return std::sqrt(sum);
}

/// Root of the mean of what is a mean square already.
double root_mean(const std::vector<Trial>& all, double Trial::*value) {
  double sum = 0;
  for (const auto& t : all) sum += t.*value / static_cast<double>(all.size());
  return std::sqrt(sum);
}

TEST(PredictedErrors, AgreeWithTheActualErrorsOfRandomRigs) {
  const char* asked = std::getenv("LIGHTSTRIPE_TRIALS");
  const int count = asked ? std::atoi(asked) : 16;
  const auto all = trials(count);
  std::map<std::string, double> square;
  for (const auto& t : all)
    for (const auto& [name, error] : t.normalised) square[name] += error * error / count;
  double mean = 0;
  for (const auto& [name, value] : square) mean += value / static_cast<double>(square.size());
  const double shape = rms(all, &Trial::shape_mm), shape_sigma = rms(all, &Trial::shape_sigma_mm);
  const double two_step = rms(all, &Trial::two_step_shape_mm);
  const double angle = root_mean(all, &Trial::plane_deg),
               angle_sigma = root_mean(all, &Trial::plane_sigma_deg);
  const double offset = root_mean(all, &Trial::plane_mm),
               offset_sigma = root_mean(all, &Trial::plane_sigma_mm);
  if (asked) {
    fmt::print("{} rigs            actual  predicted  ratio\n", count);
    const auto row = [](const char* name, double a, double b) {
      fmt::print("{:<20} {:.4f}  {:.4f}  {:.3f}\n", name, a, b, a / b);
    };
    row("plane, deg", angle, angle_sigma);
    row("plane, mm", offset, offset_sigma);
    row("section place, mm", rms(all, &Trial::absolute_mm), rms(all, &Trial::absolute_sigma_mm));
    row("section shape, mm", shape, shape_sigma);
    fmt::print("two-step shape, mm   {:.4f} ({:.2f} of it by the joint adjustment)\n", two_step,
               shape / two_step);
    fmt::print("normalised variance, mean {:.3f}\n", mean);
    for (const auto& [name, value] : square) fmt::print("  {:<32} {:.3f}\n", name, value);
  }
  // The mean of N squared standard normals has the deviation sqrt(2 / N); of the mean over all names (some
  // dozens, but dependent) half of that is taken. N = 16: 0.35 and 0.18; N = 100: 0.14 and 0.07.
  const double deviation = std::sqrt(2.0 / count);
  for (const auto& [name, value] : square) EXPECT_NEAR(value, 1, 3.3 * deviation) << name;
  EXPECT_NEAR(mean, 1, 0.1 + 1.5 * deviation / 2);
  // Root mean squares scatter by half as much.
  EXPECT_LT(shape / shape_sigma, 1.1 + deviation / 2);
  EXPECT_GT(shape / shape_sigma, 0.9 - deviation / 2);
  EXPECT_LT(angle / angle_sigma, 1.1 + deviation / 2);
  EXPECT_LT(offset / offset_sigma, 1.1 + deviation / 2);
  EXPECT_LT(shape, 0.6 * two_step);
}

}  // namespace
}  // namespace lightstripe
