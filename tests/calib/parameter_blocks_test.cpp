// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/parameter_blocks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>

namespace lightstripe {
namespace {

TEST(ParameterBlocks, APoseComesBack) {
  const Rigid3 pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized())),
                    {3, -4, 500}};
  const PoseBlock block = pose_block_of(pose);
  EXPECT_EQ(block[3], pose.rotation.w());  // Eigen's order: the real part comes last
  EXPECT_EQ(block[4], 3);
  EXPECT_LT(pose_of(block.data()).rotation.angularDistance(pose.rotation), 1e-12);
  EXPECT_EQ(pose_of(block.data()).translation, pose.translation);
  PoseBlock twice = block;
  for (std::size_t i = 0; i < 4; ++i) twice.at(i) *= 2;
  EXPECT_LT(pose_of(twice.data()).rotation.angularDistance(pose.rotation), 1e-12);  // normalised
}

TEST(ParameterBlocks, ACameraComesBackWithItsImagesSize) {
  Camera camera{960, 700, 1640, 1638, 486, 343, {}};
  for (std::size_t i = 0; i < camera.distortion.size(); ++i)
    camera.distortion.at(i) = 0.01 * (1.0 + static_cast<double>(i));
  const IntrinsicsBlock block = intrinsics_block_of(camera);
  const Camera back = camera_of(Camera{960, 700, 1, 1, 0, 0, {}}, block.data());
  EXPECT_EQ(back.width, 960);
  EXPECT_EQ(back.fy, 1638);
  EXPECT_EQ(back.cx, 486);
  EXPECT_EQ(back.distortion, camera.distortion);
}

// Four numbers and the model's own terms move, the rest stands still.
TEST(ParameterBlocks, AManifoldMovesTheModelsTermsOnly) {
  for (const auto& [lens, terms] :
       {std::pair{LensModel::kPinhole, 0}, {LensModel::kBrown4, 4}, {LensModel::kBrown5, 5}}) {
    const std::unique_ptr<ceres::Manifold> manifold(intrinsics_manifold(lens));
    EXPECT_EQ(manifold->AmbientSize(), kIntrinsics);
    ASSERT_EQ(manifold->TangentSize(), 4 + terms);
    std::array<double, kIntrinsics> x{}, moved{}, step{};
    step.fill(1);
    ASSERT_TRUE(manifold->Plus(x.data(), step.data(), moved.data()));
    EXPECT_EQ(moved[3], 1);
    EXPECT_EQ(moved[kIntrinsics - 1], 0);
  }
}

}  // namespace
}  // namespace lightstripe
