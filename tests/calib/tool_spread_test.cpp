// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// By hand-made residuals.
#include "calib/adjust/tool_spread.h"

#include <gtest/gtest.h>

namespace lightstripe {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Thirty poses, each 0.001 rad and 0.3 mm off in every component, of which this share is left to see.
std::vector<ToolResidual> equal_residuals(double redundancy) {
  std::vector<ToolResidual> all;
  for (std::size_t i = 0; i < 30; ++i) {
    Vector6d error;
    error << Eigen::Vector3d::Constant(0.001), Eigen::Vector3d::Constant(0.3);
    all.push_back({i, error * std::sqrt(redundancy), Vector6d::Constant(redundancy)});
  }
  return all;
}

TEST(ToolSpread, AllowsForWhatTheBoardsAndTheToolTake) {
  const double of_tool = std::sqrt(1 - 6 / 90.0);  // six unknowns in ninety residuals
  for (const double redundancy : {1.0, 0.5, 0.2}) {
    const ToolSpread spread = estimated_spread(equal_residuals(redundancy), {1, 1}, false);
    EXPECT_NEAR(spread.rotation * of_tool, 0.001, 1e-9) << redundancy;
    EXPECT_NEAR(spread.translation * of_tool, 0.3, 1e-6) << redundancy;
  }
}

TEST(ToolSpread, StaysWhereTheBoardsTakeAll) {
  const ToolSpread spread = estimated_spread(equal_residuals(0.01), {0.02, 0.7}, false);
  EXPECT_EQ(spread.rotation, 0.02);
  EXPECT_EQ(spread.translation, 0.7);
}

TEST(ToolSpread, TheRobustOneDoesNotFollowAFewWrongPoses) {
  auto all = equal_residuals(1);
  const double before = estimated_spread(all, {1, 1}, true).translation;
  for (std::size_t i = 0; i < 5; ++i) all[i].error[4] = 50;
  EXPECT_NEAR(estimated_spread(all, {1, 1}, true).translation, before, 1e-9);
  EXPECT_GT(estimated_spread(all, {1, 1}, false).translation, 5);
}

TEST(ToolSpread, AContradictionIsMeasuredInSigma) {
  ToolResidual one{0, Vector6d::Zero(), Vector6d::Ones()};
  one.error[3] = 0.9;
  EXPECT_FALSE(contradicts(one, {0.001, 0.2}, 3));  // 0.9 < 3 sqrt(3) 0.2 = 1.04
  EXPECT_TRUE(contradicts(one, {0.001, 0.15}, 3));
  one.redundancy[3] = 0.25;  // half of the error is left to see
  EXPECT_TRUE(contradicts(one, {0.001, 0.2}, 3));
}

}  // namespace
}  // namespace lightstripe
