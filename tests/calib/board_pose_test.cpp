// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/board_pose.h"

#include <gtest/gtest.h>

#include "calib/adjust/rig_state.h"
#include "calib/observations.h"
#include "rendered_board.h"

namespace lightstripe {
namespace {

using testing::true_corners;

const Target kTarget{TargetType::kCheckerboard, 11, 8, 10, 10};

TEST(BoardPose, IsExactForEveryLensAndPartialViews) {
  Camera tilted{640, 480, 900, 905, 330, 236, {-0.2, 0.1, 1e-3, -5e-4, 0.02}};
  tilted.distortion[12] = 0.1;
  for (const Camera& camera : {Camera{640, 480, 900, 905, 330, 236, {}}, tilted}) {
    const Rigid3 pose = testing::board_pose(kTarget, {10, -4, 450}, 30, -25, 70);
    auto corners = true_corners(camera, kTarget, pose);
    for (std::size_t i = 0; i < corners.size(); i += 3) corners[i] = unseen_corner();
    const auto found = board_pose(camera, kTarget, corners);
    ASSERT_TRUE(found);
    EXPECT_LT(rotation_angle(found->rotation * pose.rotation.conjugate()), 1e-6);
    EXPECT_LT((found->translation - pose.translation).norm(), 1e-3);
    EXPECT_LT(corner_rms_px(camera, kTarget, *found, corners), 1e-4);
  }
}

TEST(BoardPose, ThreeCornersAreTooFew) {
  const Camera camera{640, 480, 900, 905, 330, 236, {}};
  auto corners = true_corners(camera, kTarget, testing::board_pose(kTarget, {0, 0, 450}, 30, -25, 0));
  for (std::size_t i = 3; i < corners.size(); ++i) corners[i] = unseen_corner();
  EXPECT_FALSE(board_pose(camera, kTarget, corners));
}

}  // namespace
}  // namespace lightstripe
