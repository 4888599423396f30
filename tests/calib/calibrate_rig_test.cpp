// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The whole calibration on synthetic observations of known two-sensor rail rigs (see synthetic_session.h).
#include "calib/calibrate_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <cstring>
#include <opencv2/calib3d.hpp>
#include <thread>

#include "calib/adjust/session_views.h"
#include "core/error.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using testing::calibrate_with_warp;
using ::testing::HasSubstr;
using testing::noisy;
using ::testing::Not;
using testing::observe;
using testing::perfect;
using testing::rail_rig;
using testing::SessionOptions;
using testing::SyntheticRig;

/// The model of rail_rig(); on perfect data "auto" takes a leaner one that is as good to 1e-5 px.
CalibrationOptions true_lens() {
  CalibrationOptions options;
  options.lens = LensModel::kBrown5;
  options.board_warp = true;
  return options;
}
const CalibrationOptions kTrueLens = true_lens();

double plane_error_deg(const Plane& a, const Plane& b) {
  return std::asin(a.normal.cross(b.normal).norm()) / kDegree;
}

/// first_from_camera of a calibrated sensor, by way of the rig frame.
Rigid3 first_from_camera(const Rig& rig, std::size_t sensor) {
  return rig.sensors[0].rig_from_camera.inverse() * rig.sensors[sensor].rig_from_camera;
}

void expect_equal_rigs(const Rig& rig, const SyntheticRig& truth, double relative) {
  ASSERT_EQ(rig.sensors.size(), truth.sensors.size());
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    const auto& found = rig.sensors[s];
    const auto& known = truth.sensors[s];
    EXPECT_NEAR(found.camera.fx, known.camera.fx, relative * known.camera.fx);
    EXPECT_NEAR(found.camera.fy, known.camera.fy, relative * known.camera.fy);
    EXPECT_NEAR(found.camera.cx, known.camera.cx, relative * known.camera.cx);
    EXPECT_NEAR(found.camera.cy, known.camera.cy, relative * known.camera.cy);
    EXPECT_LT((found.laser_planes[0].normal - known.laser_planes[0].normal).norm(), relative);
    EXPECT_NEAR(found.laser_planes[0].offset, known.laser_planes[0].offset,
                relative * known.laser_planes[0].offset);
    const Rigid3 error = first_from_camera(rig, s) * known.cam_from_first;
    EXPECT_LT(rotation_angle(error.rotation), relative);
    EXPECT_LT(error.translation.norm(), relative * truth.range_mm);
  }
}

TEST(CalibrateRig, ReturnsTheTruthWithoutNoise) {
  const auto truth = rail_rig();
  const auto result = calibrate_rig(observe(truth, perfect()), kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_equal_rigs(result.rig, truth, 1e-7);
  const Vector3d x_first = result.rig.sensors[0].rig_from_camera.rotation.conjugate() * Vector3d::UnitX();
  EXPECT_LT((x_first - truth.direction).norm(), 1e-7);
  EXPECT_EQ(result.rig.motion.type, MotionType::kLinear);
  EXPECT_LT(result.rig.quality.sensors[1].stripe_rms_px, 1e-6);
}

/// The same rig, but its observations made by OpenCV's camera model.
CalibrationObservations observed_by_opencv(const SyntheticRig& truth, const SessionOptions& options) {
  auto observations = observe(truth, options);
  const auto poses = testing::board_poses(truth, options);
  for (int pose = 0; pose < options.poses; ++pose) {
    const Rigid3& first_from_board = poses[static_cast<std::size_t>(pose)];
    for (std::size_t s = 0; s < truth.sensors.size(); ++s) {
      const auto& camera = truth.sensors[s].camera;
      const Rigid3 cam_from_board = truth.sensors[s].cam_from_first * first_from_board;
      const Eigen::AngleAxisd turn(cam_from_board.rotation);
      const Vector3d r = turn.angle() * turn.axis(), t = cam_from_board.translation;
      std::vector<cv::Point3d> board;
      for (int i = 0; i < truth.target.num_corners(); ++i)
        board.emplace_back(truth.target.corner(i).x(), truth.target.corner(i).y(), 0);
      const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
      const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.begin() + 5);
      std::vector<cv::Point2d> pixels;
      cv::projectPoints(board, cv::Vec3d(r.x(), r.y(), r.z()), cv::Vec3d(t.x(), t.y(), t.z()), K, distortion,
                        pixels);
      auto& view = observations.sensors[s].views[static_cast<std::size_t>(pose)];
      for (std::size_t i = 0; i < pixels.size(); ++i) view.corners[i] = {pixels[i].x, pixels[i].y};
    }
  }
  return observations;
}

TEST(CalibrateRig, AgreesWithOpenCvsProjection) {
  const auto truth = rail_rig(2, 3);
  const auto result = calibrate_rig(observed_by_opencv(truth, perfect()), kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_equal_rigs(result.rig, truth, 1e-7);
}

/// Points of both sensors' laser planes, in the section of the calibrated and of the true rig.
struct Sections {
  std::vector<std::complex<double>> found, known;
};

Sections sections(const Rig& rig, const SyntheticRig& truth) {
  Sections result;
  const Eigen::Quaterniond true_rig = rig_rotation(truth.direction, {0, -1, 0});
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    for (int x = 180; x <= 780; x += 60) {
      for (int y = 150; y <= 550; y += 50) {
        const Eigen::Vector2d pixel(x, y);
        const auto p = intersect(rig.sensors[s].laser_planes[0], Vector3d::Zero(),
                                 *unproject(rig.sensors[s].camera, pixel));
        const auto q = intersect(truth.sensors[s].laser_planes[0], Vector3d::Zero(),
                                 *unproject(truth.sensors[s].camera, pixel));
        const Vector3d a = rig.sensors[s].rig_from_camera * *p;
        const Vector3d b = true_rig * (truth.sensors[s].cam_from_first.inverse() * *q);
        result.found.emplace_back(a.y(), a.z());
        result.known.emplace_back(b.y(), b.z());
      }
    }
  }
  return result;
}

/// Rms distance after the best rigid move.
double shape_error_mm(const Sections& s) {
  const auto n = s.found.size();
  std::complex<double> found_mean, known_mean, turn;
  for (std::size_t i = 0; i < n; ++i) {
    found_mean += s.found[i] / double(n);
    known_mean += s.known[i] / double(n);
  }
  for (std::size_t i = 0; i < n; ++i) turn += (s.known[i] - known_mean) * std::conj(s.found[i] - found_mean);
  turn /= std::abs(turn);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    sum += std::norm(s.known[i] - known_mean - turn * (s.found[i] - found_mean));
  return std::sqrt(sum / double(n));
}

TEST(CalibrateRig, StaysWithinTheErrorBudgetWithNoise) {
  // 20 poses, 0.07 px corners, 0.1 px stripes: predicted 0.045 degrees for a plane, 0.005 mm for the
  // section's shape where the boards were; three times that, and the figures of the issue (0.08 degrees, 0.03
  // mm).
  for (const std::uint64_t seed : {0u, 1u, 2u}) {
    const auto truth = rail_rig(2, seed);
    const auto result = calibrate_with_warp(observe(truth, noisy(20, seed)));
    ASSERT_TRUE(result.summary.usable) << result.summary.message;
    for (std::size_t s = 0; s < 2; ++s)
      EXPECT_LT(plane_error_deg(result.rig.sensors[s].laser_planes[0], truth.sensors[s].laser_planes[0]),
                0.13);
    EXPECT_LT(shape_error_mm(sections(result.rig, truth)), 0.03);
    EXPECT_NEAR(result.rig.quality.sensors[0].board_rms_px, 0.07 * std::sqrt(2.0), 0.004);  // 3520 residuals
    EXPECT_NEAR(result.rig.quality.sensors[0].stripe_rms_px, 0.1, 0.01);                    // 800 residuals
  }
}

TEST(CalibrateRig, WithoutMotionTakesXFromTheLaserAndSaysSo) {
  auto options = perfect();
  options.travel_steps = 0;
  const auto truth = rail_rig();
  const auto result = calibrate_rig(observe(truth, options), kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  const Vector3d x = result.rig.sensors[0].rig_from_camera.rotation * truth.sensors[0].laser_planes[0].normal;
  EXPECT_LT((x - Vector3d::UnitX()).norm(), 1e-7);
  EXPECT_THAT(result.rig.quality.warnings, ::testing::Contains(HasSubstr("no motion was calibrated")));
}

TEST(CalibrateRig, AnObjectThatMovesTurnsTheDirection) {
  const auto truth = rail_rig();
  auto observations = observe(truth, perfect());
  observations.motion->moves = Moves::kObject;
  const auto result = calibrate_rig(observations, kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  const Vector3d x_first = result.rig.sensors[0].rig_from_camera.rotation.conjugate() * Vector3d::UnitX();
  EXPECT_LT((x_first + truth.direction).norm(), 1e-7);
  EXPECT_EQ(result.rig.motion.moves, Moves::kObject);
}

TEST(CalibrateRig, LeavesOutOutliersAndCountsThem) {
  const auto truth = rail_rig(2, 5);
  auto observations = observe(truth, noisy(15, 5));
  for (auto& sensor : observations.sensors) {
    for (auto& view : sensor.views) view.corners[17].x() += 3;  // 1 of 88 corners
    auto& stripe = sensor.views[2].stripes[0];
    for (std::size_t i = 0; i < stripe.size() / 3; ++i) stripe[i].y += 8;  // a third of one stripe
  }
  const auto result = calibrate_with_warp(observations);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  EXPECT_LT(shape_error_mm(sections(result.rig, truth)), 0.03);
  for (const auto& view : result.summary.views) {
    const bool travels = view.image.find("travel") != std::string::npos;
    EXPECT_GE(view.left_out, travels ? 0 : 1) << view.image;
  }
}

TEST(CalibrateRig, LeavesOutAStripeThatIsNotTheLasers) {
  const auto truth = rail_rig();
  auto observations = observe(truth, perfect());
  for (auto& point : observations.sensors[1].views[3].stripes[0]) point.y += 60;  // 20 mm off
  const auto result = calibrate_rig(observations, kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_equal_rigs(result.rig, truth, 1e-7);
  EXPECT_THAT(result.rig.quality.warnings, ::testing::Contains(HasSubstr("field_3: stripe left out")));
}

TEST(CalibrateRig, LetsGoOfAStripeThatIsSlightlyWrong) {
  // 60 px nearly along the stripe puts it a few pixels beside itself: too little for the start to see. What
  // is left of its pull is that of the few points that stay within 4.5 sigma.
  const auto truth = rail_rig();
  auto observations = observe(truth, perfect());
  for (auto& point : observations.sensors[1].views[3].stripes[0]) point.x += 60;
  const auto result = calibrate_rig(observations, kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_equal_rigs(result.rig, truth, 1e-5);
}

TEST(CalibrateRig, LeavesOutAViewWithCornersInAWrongOrder) {
  const auto truth = rail_rig();
  auto observations = observe(truth, perfect(12));
  auto& corners = observations.sensors[0].views[4].corners;
  std::rotate(corners.begin(), corners.begin() + 11, corners.end());
  const auto result = calibrate_rig(observations, kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_equal_rigs(result.rig, truth, 1e-7);
  EXPECT_THAT(result.rig.quality.warnings, ::testing::Contains(HasSubstr("gauge_4: left out")));
}

TEST(CalibrateRig, ResolvesABoardThatLooksTheSameUpsideDown) {
  auto truth = rail_rig();
  truth.target.rows = 7;
  auto observations = observe(truth, perfect());
  const auto half_turn = corner_orders(truth.target)[1];
  for (std::size_t i = 0; i < observations.sensors[1].views.size(); i += 2)
    observations.sensors[1].views[i].corners = relisted(observations.sensors[1].views[i].corners, half_turn);
  observations.motion->views[2].corners = relisted(observations.motion->views[2].corners, half_turn);
  const auto result = calibrate_rig(observations, kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_equal_rigs(result.rig, truth, 1e-7);
  for (const auto& view : result.summary.views) EXPECT_EQ(view.left_out, 0) << view.image;
}

TEST(CalibrateRig, ChainsSensorsThatShareNoPoseWithTheFirst) {
  // Sensor 2 sees poses 6 to 11, the first 0 to 7 and the second all of them.
  const auto truth = rail_rig(3);
  auto observations = observe(truth, perfect(12));
  auto& first = observations.sensors[0].views;
  auto& third = observations.sensors[2].views;
  first.erase(first.begin() + 8, first.end());
  third.erase(third.begin(), third.begin() + 8);
  const auto result = calibrate_rig(observations, kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  expect_equal_rigs(result.rig, truth, 1e-6);
}

TEST(CalibrateRig, FindsARotaryAxis) {
  const auto truth = rail_rig(1);
  auto observations = observe(truth, perfect());
  const Vector3d axis = Vector3d(0.9, 0.1, -0.2).normalized(), point(5, 10, 560);
  Random random(3);
  const Rigid3 board = testing::visible_board(truth, {.max_tilt_deg = 5}, random);
  auto& motion = *observations.motion;
  motion.type = MotionType::kRotary;
  motion.moves = Moves::kObject;
  motion.views.clear();
  motion.travel.clear();
  for (int i = 0; i < 5; ++i) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd((i - 1) * 8 * kDegree, axis));
    BoardView view;
    view.corners = testing::seen_corners(truth.target, truth.sensors[0].camera,
                                         Rigid3{turn, point - turn * point} * board);
    motion.views.push_back(view);
    motion.travel.push_back((i - 1) * 8.0);
  }
  const auto result = calibrate_rig(observations, kTrueLens);
  ASSERT_TRUE(result.summary.usable) << result.summary.message;
  const Rigid3 camera_from_rig = result.rig.sensors[0].rig_from_camera.inverse();
  const Vector3d found_axis = camera_from_rig.rotation * result.rig.motion.axis_direction;
  const double sense = found_axis.dot(axis) > 0 ? 1 : -1;
  EXPECT_LT((found_axis - sense * axis).norm(), 1e-7);
  EXPECT_LT((camera_from_rig * result.rig.motion.axis_point - point).cross(axis).norm(), 1e-5);
  EXPECT_NEAR(result.rig.motion.axis_point.dot(result.rig.motion.axis_direction), 0, 1e-9)
      << "the point nearest to the origin";
  EXPECT_THAT(result.rig.quality.warnings, ::testing::Not(::testing::Contains(HasSubstr("motion"))));
  // The object turned by +angle about `axis`; about the opposite axis that is a rig that turns.
  EXPECT_EQ(result.rig.motion.moves == Moves::kRig, sense < 0);
}

/// Bit for bit, apart from the sign of nothing.
bool same_bits(const CalibrationResult& a, const CalibrationResult& b) {
  const auto equal = [](const double& x, const double& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  bool same = a.rig.sensors.size() == b.rig.sensors.size() &&
              a.rig.quality.sigma.size() == b.rig.quality.sigma.size();
  for (std::size_t s = 0; same && s < a.rig.sensors.size(); ++s) {
    const auto &p = a.rig.sensors[s], &q = b.rig.sensors[s];
    same = equal(p.camera.fx, q.camera.fx) && equal(p.camera.distortion[4], q.camera.distortion[4]) &&
           equal(p.laser_planes[0].normal.x(), q.laser_planes[0].normal.x()) &&
           equal(p.laser_planes[0].offset, q.laser_planes[0].offset) &&
           equal(p.rig_from_camera.translation.x(), q.rig_from_camera.translation.x());
  }
  for (const auto& [name, sigma] : a.rig.quality.sigma)
    same = same && equal(sigma, b.rig.quality.sigma.at(name));
  return same && equal(a.rig.quality.section_shape_sigma_mm, b.rig.quality.section_shape_sigma_mm);
}

TEST(CalibrateRig, GivesTheSameBitsEveryTimeAndInEveryThread) {
  const auto observations = observe(rail_rig(), noisy(8));
  const auto first = calibrate_with_warp(observations);
  std::vector<CalibrationResult> results(3);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = calibrate_with_warp(observations); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_TRUE(same_bits(first, result));
}

TEST(CalibrateRig, RefusesOptionsThatMeanNothing) {
  const auto observations = observe(rail_rig(1), perfect(3));
  CalibrationOptions options;
  options.outlier_sigma = -1;
  EXPECT_THROW(calibrate_rig(observations, options), Error);
  options = {};
  options.corner_sigma_px = 0;
  EXPECT_THROW(calibrate_rig(observations, options), Error);
}

TEST(CalibrateRig, StartsAsNotRun) {
  EXPECT_FALSE(CalibrationSummary{}.usable);
  EXPECT_EQ(CalibrationSummary{}.message, "not run");
}

}  // namespace
}  // namespace lightstripe
