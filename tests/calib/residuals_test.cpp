// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/residuals.h"

#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

#include "calib/adjust/rig_state.h"
#include "calib/adjust/stripe_crossing.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Analytic against numeric derivatives, relative.
bool gradients_agree(const ceres::CostFunction& function, const std::vector<const double*>& blocks,
                     std::string* why) {
  ceres::NumericDiffOptions numeric;
  numeric.ridders_relative_initial_step_size = 1e-3;
  const ceres::GradientChecker checker(
      &function, static_cast<const std::vector<const ceres::Manifold*>*>(nullptr), numeric);
  ceres::GradientChecker::ProbeResults results;
  const bool good = checker.Probe(blocks.data(), 1e-6, &results);
  *why = results.error_log;
  return good;
}

struct Blocks {
  std::array<double, kIntrinsics> intrinsics{1640, 1635,  482,  347,  -0.09, 0.12,  4e-4, -3e-4, 0.2,
                                             0.01, -0.02, 0.03, 1e-3, 2e-3,  -1e-3, 5e-4, 0.02,  -0.03};
  std::array<double, 7> cam_from_first{}, first_from_board{};
  std::array<double, 4> plane{};
  std::array<double, 2> warp{0.3, -0.2};
  std::array<double, 3> direction{}, axis_point{10, -20, 500};

  Blocks() {
    const Eigen::Quaterniond a(Eigen::AngleAxisd(0.7, Vector3d(0.2, 0.8, 0.5).normalized()));
    const Eigen::Quaterniond b(Eigen::AngleAxisd(-0.5, Vector3d(0.6, 0.1, -0.3).normalized()));
    cam_from_first = {a.x(), a.y(), a.z(), a.w(), -320, 40, 180};
    first_from_board = {b.x(), b.y(), b.z(), b.w(), 10, 20, 560};
    const Vector3d n = Vector3d(0.1, 0.75, 0.6).normalized();
    plane = {n.x(), n.y(), n.z(), 350};
    const Vector3d d = Vector3d(0.1, 0.9, -0.4).normalized();
    direction = {d.x(), d.y(), d.z()};
  }
};

/// A place on an 11 x 8 board of 10 mm pitch.
BoardPlace place(double x, double y) {
  return board_place({TargetType::kCheckerboard, 11, 8, 10, 10}, {x, y});
}
constexpr std::array<double, 2> kFlat{0, 0};

TEST(CornerResidual, IsThePixelDistanceInSigma) {
  // Board frame = camera frame shifted by 500 mm: the point (50, -25, 500) is seen at f * (0.1, -0.05) + c.
  std::array<double, kIntrinsics> intrinsics{1000, 2000, 300, 200};
  const std::array<double, 7> identity{0, 0, 0, 1, 0, 0, 0}, ahead{0, 0, 0, 1, 0, 0, 500};
  const CornerResidual residual(place(50, -25), {399, 101.5}, 0.5);
  const double* blocks[] = {intrinsics.data(), identity.data(), ahead.data(), kFlat.data()};
  double r[2];
  ASSERT_TRUE(residual.Evaluate(blocks, r, nullptr));
  EXPECT_NEAR(r[0], (400 - 399) / 0.5, 1e-12);
  EXPECT_NEAR(r[1], (100 - 101.5) / 0.5, 1e-12);
}

TEST(CornerResidual, RefusesPointsBehindTheCamera) {
  const Blocks b;
  const std::array<double, 7> behind{0, 0, 0, 1, 0, 0, -5000};
  const CornerResidual residual(place(0, 0), {0, 0}, 1);
  const double* blocks[] = {b.intrinsics.data(), b.cam_from_first.data(), behind.data(), kFlat.data()};
  double r[2];
  EXPECT_FALSE(residual.Evaluate(blocks, r, nullptr));
}

TEST(CornerResidual, GradientAgreesWithDifferences) {
  const Blocks b;
  const CornerResidual residual(place(30, 40), {500, 400}, 0.07);
  std::string why;
  EXPECT_TRUE(gradients_agree(
      residual, {b.intrinsics.data(), b.cam_from_first.data(), b.first_from_board.data(), b.warp.data()},
      &why))
      << why;
}

TEST(TravelCornerResidual, ShiftsThePointAlongTheDirection) {
  std::array<double, kIntrinsics> intrinsics{1000, 1000, 0, 0};
  const std::array<double, 7> identity{0, 0, 0, 1, 0, 0, 0}, ahead{0, 0, 0, 1, 0, 0, 500};
  const std::array<double, 3> along_y{0, 1, 0}, origin{0, 0, 0};
  const TravelCornerResidual residual(place(0, 0), {0, 0}, 1, MotionType::kLinear, 25);
  const double* blocks[] = {intrinsics.data(), identity.data(), ahead.data(),
                            kFlat.data(),      along_y.data(),  origin.data()};
  double r[2];
  ASSERT_TRUE(residual.Evaluate(blocks, r, nullptr));
  EXPECT_NEAR(r[0], 0, 1e-12);
  EXPECT_NEAR(r[1], 50, 1e-12);
}

TEST(TravelCornerResidual, TurnsThePointAboutTheAxis) {
  // (100, 0, 500) turned by 90 degrees about the axis along y through (0, 0, 500) comes to (0, 0, 400).
  std::array<double, kIntrinsics> intrinsics{1000, 1000, 0, 0};
  const std::array<double, 7> identity{0, 0, 0, 1, 0, 0, 0}, ahead{0, 0, 0, 1, 0, 0, 500};
  const std::array<double, 3> along_y{0, 1, 0}, on_axis{0, 7, 500};
  const TravelCornerResidual residual(place(100, 20), {0, 0}, 1, MotionType::kRotary, std::acos(-1.0) / 2);
  const double* blocks[] = {intrinsics.data(), identity.data(), ahead.data(),
                            kFlat.data(),      along_y.data(),  on_axis.data()};
  double r[2];
  ASSERT_TRUE(residual.Evaluate(blocks, r, nullptr));
  EXPECT_NEAR(r[0], 0, 1e-10);
  EXPECT_NEAR(r[1], 1000 * 20 / 400.0, 1e-10);
}

TEST(TravelCornerResidual, GradientAgreesWithDifferences) {
  const Blocks b;
  std::string why;
  for (const auto motion : {MotionType::kLinear, MotionType::kRotary}) {
    const TravelCornerResidual residual(place(30, 40), {500, 400}, 0.07, motion,
                                        motion == MotionType::kLinear ? 25 : 0.3);
    EXPECT_TRUE(gradients_agree(residual,
                                {b.intrinsics.data(), b.cam_from_first.data(), b.first_from_board.data(),
                                 b.warp.data(), b.direction.data(), b.axis_point.data()},
                                &why))
        << why;
  }
}

TEST(StripeResidual, IsTheDistanceToTheProjectedLine) {
  // Board: the plane z = 500; laser: x = 0.2 z, which meets it at x = 100, seen at 1000 * 0.2 + 320 = 520,
  // upright.
  std::array<double, kIntrinsics> intrinsics{1000, 1000, 320, 240};
  const std::array<double, 7> identity{0, 0, 0, 1, 0, 0, 0}, ahead{0, 0, 0, 1, 0, 0, 500};
  const Vector3d n = Vector3d(1, 0, -0.1).normalized();
  const std::array<double, 4> plane{n.x(), n.y(), n.z(), n.dot(Vector3d(100, 0, 500))};
  const Camera camera{640, 480, 1000, 1000, 320, 240, {}};
  const Vector2d pixel(518, 100);
  const auto frame = stripe_crossing(camera, {Vector3d::UnitZ(), 500}, {n, plane[3]}, pixel);
  ASSERT_TRUE(frame);
  EXPECT_NEAR(std::abs(frame->normal.x()), 1, 1e-9);
  EXPECT_NEAR(std::abs(frame->distance_px), 2, 1e-9);
  const StripeResidual residual(place(100, 0), pixel, frame->normal, frame->across, 0.1);
  const double* blocks[] = {intrinsics.data(), identity.data(), ahead.data(), kFlat.data(), plane.data()};
  double r = 0;
  ASSERT_TRUE(residual.Evaluate(blocks, &r, nullptr));
  EXPECT_NEAR(std::abs(r), 2 / 0.1, 1e-6);
}

TEST(StripeResidual, GradientAgreesWithDifferences) {
  const Blocks b;
  const Rigid3 cam_from_first{Eigen::Quaterniond(b.cam_from_first.data()),
                              Vector3d(b.cam_from_first.data() + 4)};
  const Rigid3 first_from_board{Eigen::Quaterniond(b.first_from_board.data()),
                                Vector3d(b.first_from_board.data() + 4)};
  const Rigid3 cam_from_board = cam_from_first * first_from_board;
  // A laser plane through the board's middle, so that the stripe is in view.
  const Vector3d n = (Vector3d(b.plane.data()) + 0.1 * Vector3d::UnitX()).normalized();
  const std::array<double, 4> plane{n.x(), n.y(), n.z(), n.dot(cam_from_board.translation)};
  Camera camera{960, 700, b.intrinsics[0], b.intrinsics[1], b.intrinsics[2], b.intrinsics[3], {}};
  std::copy(b.intrinsics.begin() + 4, b.intrinsics.end(), camera.distortion.begin());
  const auto pixel = project(camera, cam_from_board.translation);
  ASSERT_TRUE(pixel);
  const auto frame =
      stripe_crossing(camera, board_plane(cam_from_board), {n, plane[3]}, *pixel + Vector2d(0.5, -0.3));
  ASSERT_TRUE(frame);
  const StripeResidual residual(place(7, 22), *pixel, frame->normal, frame->across, 0.1);
  std::string why;
  EXPECT_TRUE(gradients_agree(
      residual,
      {b.intrinsics.data(), b.cam_from_first.data(), b.first_from_board.data(), b.warp.data(), plane.data()},
      &why))
      << why;
}

}  // namespace
}  // namespace lightstripe
