// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The rig on a robot's tool from noisy poses, against the truth; the bound: adjust_with_tool.scene_test.cpp.
#include "calib/adjust/hand_eye.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/adjust/rig_state.h"
#include "core/random.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

constexpr double kTurnNoise = 0.02 * kDegree, kShiftNoise_mm = 0.1;

const Rigid3 kToolFromFirst{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, 2, -1).normalized())),
                            {80, -30, 120}};
const Rigid3 kBaseFromBoard{Eigen::Quaterniond(Eigen::AngleAxisd(2.8, Vector3d(1, 0.1, 0).normalized())),
                            {600, 100, 50}};

Eigen::Quaterniond small_turn(Random& random, double sigma) {
  const Vector3d w(sigma * random.gaussian(), sigma * random.gaussian(), sigma * random.gaussian());
  return w.norm() > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(w.norm(), w.normalized()))
                      : Eigen::Quaterniond::Identity();
}

/// Boards 500 mm away, tilted to all sides; the tool's poses with noise.
std::vector<ToolView> views(int count, std::uint64_t seed, double noise, double max_tilt = 0.6) {
  Random random(seed);
  std::vector<ToolView> result;
  for (int i = 0; i < count; ++i) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(-max_tilt, max_tilt), Vector3d::UnitX())) *
        Eigen::AngleAxisd(random.uniform(-max_tilt, max_tilt), Vector3d::UnitY()) *
        Eigen::AngleAxisd(random.uniform(-max_tilt, max_tilt), Vector3d::UnitZ());
    ToolView view;
    view.image = std::to_string(i);
    view.first_from_board = {turn,
                             {random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(450, 550)}};
    view.base_from_tool = kBaseFromBoard * view.first_from_board.inverse() * kToolFromFirst.inverse();
    const Rigid3 error{
        small_turn(random, noise * kTurnNoise),
        noise * kShiftNoise_mm * Vector3d(random.gaussian(), random.gaussian(), random.gaussian())};
    view.base_from_tool = view.base_from_tool * error;
    result.push_back(view);
  }
  return result;
}

TEST(HandEye, ReturnsTheTruthWithoutNoise) {
  const HandEye found = find_hand_eye(views(12, 1, 0));
  const Rigid3 error = found.tool_from_first * kToolFromFirst.inverse();
  EXPECT_LT(rotation_angle(error.rotation), 1e-7);
  EXPECT_LT(error.translation.norm(), 1e-4);
}

TEST(HandEye, SaysTheSpreadOfThePoses) {
  const HandEye found = find_hand_eye(views(30, 10, 1));
  EXPECT_NEAR(found.spread.rotation / kTurnNoise, 1, 0.25);  // 90 components: 7 %
  EXPECT_NEAR(found.spread.translation / kShiftNoise_mm, 1, 0.25);
}

TEST(HandEye, IsNotPulledByAPoseThatIsNotThePictures) {
  auto all = views(20, 3, 1);
  const Rigid3 before = find_hand_eye(all).tool_from_first;
  all[7].base_from_tool.translation.x() += 15;
  EXPECT_LT((find_hand_eye(all).tool_from_first.translation - before.translation).norm(), kShiftNoise_mm);
}

std::string refusal(const std::vector<ToolView>& all) {
  try {
    find_hand_eye(all);
  } catch (const NotUsable& reason) {
    return reason.what();
  }
  return "";
}

TEST(HandEyeRefuses, PosesThatDoNotMoveOrTurnAboutOneAxisOrContradict) {
  auto standing = views(10, 4, 1);
  for (auto& view : standing) view.base_from_tool = standing[0].base_from_tool;
  EXPECT_THAT(refusal(standing), HasSubstr("do not move"));
  auto one_axis = views(10, 5, 0);
  for (std::size_t i = 0; i < one_axis.size(); ++i)
    one_axis[i].base_from_tool.rotation =
        Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * static_cast<double>(i), Vector3d::UnitZ()));
  EXPECT_THAT(refusal(one_axis), HasSubstr("one axis only"));
  auto shifted = views(12, 6, 1);
  const auto before = shifted;
  for (std::size_t i = 0; i < shifted.size(); ++i)
    shifted[i].base_from_tool = before[(i + 1) % before.size()].base_from_tool;
  EXPECT_THAT(refusal(shifted), HasSubstr("contradict"));
}

}  // namespace
}  // namespace lightstripe
