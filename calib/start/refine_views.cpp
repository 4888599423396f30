// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/refine_views.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/product_manifold.h>
#include <ceres/solver.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "calib/adjust/board_surface.h"
#include "calib/adjust/residuals.h"
#include "calib/observations.h"

namespace lightstripe {
namespace {

using PoseManifold = ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<3>>;
using PoseBlock = std::array<double, 7>;

constexpr int kFreeDistortion = 4;  // k1 k2 p1 p2

PoseBlock block_of(const Rigid3& pose) {
  const auto& q = pose.rotation;
  const auto& t = pose.translation;
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

Rigid3 pose_of(const PoseBlock& b) {
  return {Eigen::Quaterniond(b[3], b[0], b[1], b[2]).normalized(), {b[4], b[5], b[6]}};
}

/// The blocks of one camera and its views; a board's own pose and warp are constants.
struct Blocks {
  std::array<double, kIntrinsics> camera{};
  PoseBlock board = block_of(Rigid3{});
  std::array<double, 2> warp{};
  std::vector<PoseBlock> poses;

  explicit Blocks(const Camera& start) {
    camera = {start.fx, start.fy, start.cx, start.cy};
    std::copy(start.distortion.begin(), start.distortion.end(), camera.begin() + 4);
  }
  void add(ceres::Problem& problem, const Target& target, const std::vector<Eigen::Vector2d>& corners,
           PoseBlock& pose) {
    problem.AddParameterBlock(pose.data(), 7, new PoseManifold);
    for (int i = 0; i < target.num_corners(); ++i) {
      const Eigen::Vector2d& corner = corners[static_cast<std::size_t>(i)];
      if (is_seen(corner))
        problem.AddResidualBlock(new CornerResidual(board_place(target, target.corner(i)), corner, 1.0),
                                 nullptr, camera.data(), pose.data(), board.data(), warp.data());
    }
    problem.SetParameterBlockConstant(board.data());
    problem.SetParameterBlockConstant(warp.data());
  }
};

bool solve(ceres::Problem& problem, ceres::LinearSolverType solver,
           std::shared_ptr<ceres::ParameterBlockOrdering> ordering = nullptr) {
  ceres::Solver::Options options;
  options.linear_solver_type = solver;
  options.linear_solver_ordering = std::move(ordering);
  options.num_threads = 1;  // more would add in the order of arrival: other bits in every run
  options.max_num_iterations = 100;
  options.function_tolerance = options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable();
}

}  // namespace

bool refine_pose(const Camera& camera, const Target& target, const std::vector<Eigen::Vector2d>& corners,
                 Rigid3& cam_from_board) {
  ceres::Problem problem;
  Blocks blocks(camera);
  PoseBlock pose = block_of(cam_from_board);
  blocks.add(problem, target, corners, pose);
  problem.SetParameterBlockConstant(blocks.camera.data());
  if (!solve(problem, ceres::DENSE_QR)) return false;
  cam_from_board = pose_of(pose);
  return true;
}

bool refine_camera(Camera& camera, const Target& target,
                   const std::vector<const std::vector<Eigen::Vector2d>*>& corners,
                   std::vector<Rigid3>& cam_from_board) {
  ceres::Problem problem;
  Blocks blocks(camera);
  blocks.poses.resize(corners.size());  // stays where it is: the problem points into it
  for (std::size_t i = 0; i < corners.size(); ++i) {
    blocks.poses[i] = block_of(cam_from_board[i]);
    blocks.add(problem, target, *corners[i], blocks.poses[i]);
  }
  std::vector<int> fixed(kIntrinsics - 4 - kFreeDistortion);
  std::iota(fixed.begin(), fixed.end(), 4 + kFreeDistortion);
  problem.SetManifold(blocks.camera.data(), new ceres::SubsetManifold(kIntrinsics, fixed));
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (PoseBlock& pose : blocks.poses) ordering->AddElementToGroup(pose.data(), 0);
  for (double* shared : {blocks.camera.data(), blocks.board.data(), blocks.warp.data()})
    ordering->AddElementToGroup(shared, 1);
  if (!solve(problem, ceres::DENSE_SCHUR, ordering)) return false;
  camera.fx = blocks.camera[0], camera.fy = blocks.camera[1];
  camera.cx = blocks.camera[2], camera.cy = blocks.camera[3];
  std::copy(blocks.camera.begin() + 4, blocks.camera.end(), camera.distortion.begin());
  for (std::size_t i = 0; i < corners.size(); ++i) cam_from_board[i] = pose_of(blocks.poses[i]);
  return true;
}

}  // namespace lightstripe
