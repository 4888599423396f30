// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/board_poses.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

int corners_in_view(const SimulatedSensor& sensor, const Target& target, const Rigid3& pose,
                    const Rigid3& moved) {
  const View view{&sensor, moved, 0, 0};
  int seen = 0;
  for (int i = 0; i < target.num_corners(); ++i)
    seen += pixel_of(view, pose * Vector3d(target.corner(i).x(), target.corner(i).y(), 0)).has_value();
  return seen;
}

double degrees_between(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::min(1.0, std::abs(a.normalized().dot(b.normalized())))) * 180 / std::numbers::pi;
}

class BoardPoses : public ::testing::Test {
 protected:
  const Scene scene{};
  const std::vector<SimulatedSensor> sensors = make_sensors(scene);
  const Target target = target_of(scene.boards);
};

TEST_F(BoardPoses, EverySensorSeesEveryCornerFromTheFront) {
  const auto poses = draw_board_poses(scene, sensors);
  ASSERT_EQ(poses.size(), 20U);
  for (const Rigid3& pose : poses)
    for (const SimulatedSensor& sensor : sensors) {
      EXPECT_EQ(corners_in_view(sensor, target, pose, {}), target.num_corners());
      // z goes into the board: along the line of sight.
      EXPECT_GT(
          (pose.rotation * Vector3d::UnitZ()).dot(pose.translation - sensor.world_from_camera.translation),
          0);
    }
}

TEST_F(BoardPoses, TiltsSpreadInDirectionAndSize) {
  const auto poses = draw_board_poses(scene, sensors);
  double largest = 0;
  Vector3d mean = Vector3d::Zero();
  for (const Rigid3& pose : poses) mean += pose.rotation * Vector3d::UnitZ() / 20;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Rigid3& pose : poses) {
    const Vector3d normal = pose.rotation * Vector3d::UnitZ();
    largest = std::max(largest, degrees_between(normal, mean));
    scatter += (normal - mean) * (normal - mean).transpose() / 20;
  }
  EXPECT_GT(largest, 25);
  // Two directions in which the normals differ by more than 6 degrees rms (0.105^2): no family of parallel
  // stripes.
  const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
  EXPECT_GT(spread[1], 0.011);
}

TEST_F(BoardPoses, EveryLaserCrossesEveryBoard) {
  for (const Rigid3& pose : draw_board_poses(scene, sensors))
    for (const SimulatedSensor& sensor : sensors) {
      double low = 1e9, high = -1e9;
      for (int i = 0; i < target.num_corners(); ++i) {
        const Eigen::Vector2d corner = target.corner(i);
        const double off = sensor.sheet.signed_distance(pose * Vector3d(corner.x(), corner.y(), 0));
        low = std::min(low, off);
        high = std::max(high, off);
      }
      EXPECT_LT(low, 10);  // one square beyond the corners still belongs to the pattern
      EXPECT_GT(high, -10);
      EXPECT_GT(degrees_between(sensor.sheet.normal, pose.rotation * Vector3d::UnitZ()), 20);
    }
}

TEST_F(BoardPoses, SeedDecides) {
  Scene other;
  other.seed = 2;
  const Rigid3 first = draw_board_poses(scene, sensors)[0];
  EXPECT_EQ(first.translation, draw_board_poses(scene, sensors)[0].translation);
  EXPECT_NE(first.translation, draw_board_poses(other, sensors)[0].translation);
}

TEST_F(BoardPoses, CutOffPosesLeaveTheFirstSensorsImageInPart) {
  Scene cut;
  cut.boards.count = 6;
  cut.boards.cut_off = 2;
  cut.boards.spread = {60, 90, 90};
  const auto poses = draw_board_poses(cut, sensors);
  for (std::size_t i = 0; i < 6; ++i) {
    const int seen = corners_in_view(sensors[0], target, poses[i], {});
    EXPECT_EQ(seen == target.num_corners(), i < 4) << i;
    EXPECT_GT(2 * seen, target.num_corners());
  }
}

TEST_F(BoardPoses, MotionBoardStaysInViewOverTheWholeTravel) {
  const Rigid3 pose = draw_motion_board(scene, sensors);
  for (const int position : {0, 5, 9})
    EXPECT_EQ(corners_in_view(sensors[0], target, pose, moved_at(scene, position * scene.motion.step_mm)),
              target.num_corners());
}

TEST_F(BoardPoses, ImpossibleWishesAreRefused) {
  Scene large;
  large.boards.square_mm = {60, 60};
  EXPECT_THROW(draw_board_poses(large, sensors), Error);
  Scene far;
  far.motion.step_mm = 200;
  EXPECT_THROW(draw_motion_board(far, sensors), Error);
}

TEST_F(BoardPoses, MovingTheObjectIsMovingTheRigTheOtherWay) {
  Scene object;
  object.motion.moves = Moves::kObject;
  EXPECT_EQ(moved_at(scene, 7).translation, Vector3d(7, 0, 0));
  EXPECT_EQ(moved_at(object, 7).translation, Vector3d(-7, 0, 0));
}

}  // namespace
}  // namespace lightstripe
