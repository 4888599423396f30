// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The covariance by hand against Ceres' own.
#include "calib/adjust/reduced_covariance.h"

#include <ceres/covariance.h>
#include <gtest/gtest.h>

#include "calib/adjust/joint_adjustment.h"
#include "calib/adjust/session_views.h"
#include "calib/start/initial_values.h"
#include "synthetic_session.h"

namespace lightstripe {
namespace {

struct Solved {
  InitialValues start;
  JointAdjustment adjustment;

  JointProblem problem() const {
    ProblemOptions options;
    options.lenses = adjustment.lenses;
    options.board_warp = false;
    return {start.session, adjustment.state, adjustment.residuals, options};
  }
};

Solved solved_session() {
  auto truth = testing::rail_rig(1, 3);
  truth.sensors[0].camera.distortion[4] = 0;
  Solved solved;
  solved.start =
      initial_values(prepare_session_views(testing::observe(truth, {.poses = 8, .travel_steps = 0})));
  CalibrationOptions options;
  options.board_warp = false;
  solved.adjustment = adjust_jointly(solved.start.session, solved.start.state, {LensModel::kBrown4}, options);
  return solved;
}

TEST(ReducedCovariance, IsThatOfCeres) {
  const Solved solved = solved_session();
  ASSERT_TRUE(solved.adjustment.converged);
  JointProblem joint = solved.problem();
  const ReducedCovariance reduced = reduced_covariance(joint);
  ASSERT_EQ(reduced.covariance.rows(), joint.num_globals());

  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance covariance(options);
  const auto blocks = joint.blocks();
  std::vector<std::pair<const double*, const double*>> pairs;
  for (std::size_t i = 0; i < joint.globals().size(); ++i) pairs.emplace_back(blocks[i], blocks[i]);
  ASSERT_TRUE(covariance.Compute(pairs, &joint.problem()));
  for (std::size_t i = 0; i < joint.globals().size(); ++i) {
    const auto& block = joint.globals()[i];
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> known(block.size, block.size);
    ASSERT_TRUE(covariance.GetCovarianceBlockInTangentSpace(blocks[i], blocks[i], known.data()));
    const auto found = reduced.covariance.block(block.column, block.column, block.size, block.size);
    for (int k = 0; k < block.size; ++k)
      EXPECT_NEAR(found(k, k) / known(k, k), 1, 1e-4) << "block " << i << ", unknown " << k;
  }
}

TEST(ReducedCovariance, ADirectionThatTheViewsLeaveOpenIsSaid) {
  Solved solved = solved_session();
  for (auto& residual : solved.adjustment.residuals)  // no stripe: nothing tells where the laser plane is
    if (!residual.is_corner()) residual.used = false;
  JointProblem joint = solved.problem();
  const ReducedCovariance reduced = reduced_covariance(joint);
  EXPECT_EQ(reduced.covariance.size(), 0);
  EXPECT_GT(reduced.condition, 1e13);
}

TEST(MovedState, GoesThereAndBack) {
  const Solved solved = solved_session();
  const auto& a = solved.adjustment;
  const Eigen::VectorXd delta = Eigen::VectorXd::Constant(a.covariance.rows(), 1e-4);
  const RigState there = moved_state(a.state, a.globals, delta), back = moved_state(there, a.globals, -delta);
  EXPECT_NEAR(there.sensors[0].camera.fx - a.state.sensors[0].camera.fx, 1e-4, 1e-12);
  EXPECT_GT((there.sensors[0].laser_planes[0].normal - a.state.sensors[0].laser_planes[0].normal).norm(),
            5e-5);
  EXPECT_NEAR(back.sensors[0].camera.fx, a.state.sensors[0].camera.fx, 1e-9);
  EXPECT_LT((back.sensors[0].laser_planes[0].normal - a.state.sensors[0].laser_planes[0].normal).norm(),
            1e-7);
}

}  // namespace
}  // namespace lightstripe
