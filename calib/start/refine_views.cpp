// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/refine_views.h"

#include <ceres/problem.h>
#include <ceres/solver.h>

#include <memory>

#include "calib/adjust/board_surface.h"
#include "calib/adjust/parameter_blocks.h"
#include "calib/adjust/residuals.h"
#include "calib/observations.h"

namespace lightstripe {
namespace {

/// The blocks of one camera and its views; a board's own pose and warp are constants.
struct Blocks {
  IntrinsicsBlock camera;
  PoseBlock board = pose_block_of(Rigid3{});
  std::array<double, 2> warp{};
  std::vector<PoseBlock> poses;

  explicit Blocks(const Camera& start) : camera(intrinsics_block_of(start)) {}
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
  PoseBlock pose = pose_block_of(cam_from_board);
  blocks.add(problem, target, corners, pose);
  problem.SetParameterBlockConstant(blocks.camera.data());
  if (!solve(problem, ceres::DENSE_QR)) return false;
  cam_from_board = pose_of(pose.data());
  return true;
}

bool refine_camera(Camera& camera, const Target& target,
                   const std::vector<const std::vector<Eigen::Vector2d>*>& corners,
                   std::vector<Rigid3>& cam_from_board) {
  ceres::Problem problem;
  Blocks blocks(camera);
  blocks.poses.resize(corners.size());  // stays where it is: the problem points into it
  for (std::size_t i = 0; i < corners.size(); ++i) {
    blocks.poses[i] = pose_block_of(cam_from_board[i]);
    blocks.add(problem, target, *corners[i], blocks.poses[i]);
  }
  problem.SetManifold(blocks.camera.data(), intrinsics_manifold(LensModel::kBrown4));
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (PoseBlock& pose : blocks.poses) ordering->AddElementToGroup(pose.data(), 0);
  for (double* shared : {blocks.camera.data(), blocks.board.data(), blocks.warp.data()})
    ordering->AddElementToGroup(shared, 1);
  if (!solve(problem, ceres::DENSE_SCHUR, ordering)) return false;
  camera = camera_of(camera, blocks.camera.data());
  for (std::size_t i = 0; i < corners.size(); ++i) cam_from_board[i] = pose_of(blocks.poses[i].data());
  return true;
}

}  // namespace lightstripe
