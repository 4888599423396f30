// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/joint_problem.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/product_manifold.h>
#include <ceres/sphere_manifold.h>

#include <algorithm>

#include "calib/adjust/board_surface.h"
#include "calib/adjust/parameter_blocks.h"
#include "calib/adjust/residuals.h"
#include "core/error.h"

namespace lightstripe {
namespace {

using PlaneManifold = ceres::ProductManifold<ceres::SphereManifold<3>, ceres::EuclideanManifold<1>>;

constexpr std::size_t kWellKnownTerms = 5;  // a model with more of them has terms that trade off

std::array<double, 4> plane_block_of(const Plane& plane) {
  return {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset};
}

Plane plane_of(const double* block) {
  return {Eigen::Vector3d(block[0], block[1], block[2]).normalized(), block[3]};
}

std::array<double, 3> block_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// A point of the axis is free across it only: the coordinate along the axis' largest component stays.
ceres::Manifold* axis_point_manifold(const Eigen::Vector3d& direction) {
  int largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return new ceres::SubsetManifold(3, {largest});
}

}  // namespace

JointProblem::JointProblem(const SessionViews& session, const RigState& state,
                           const std::vector<Residual>& list, const ProblemOptions& options)
    : session_(&session), start_(state), options_(options) {
  store_state(state);
  problem_ = std::make_unique<ceres::Problem>();
  add_blocks(list);
  for (const auto& residual : list) {
    if (!residual.used) continue;
    const auto& view = session.views[residual.view];
    residual.is_corner() ? add_corner(view, residual) : add_stripe_point(view, residual);
  }
  if (state.tool) add_tool();
  for (const auto& block : globals_)  // behind the corners and points, whose residuals are read in order
    if (block.kind == GlobalBlock::Kind::kIntrinsics && free_terms(block.lens).size() > kWellKnownTerms)
      problem_->AddResidualBlock(new LensPrior(free_terms(block.lens)), nullptr,
                                 intrinsics_[static_cast<std::size_t>(block.sensor)]);
}

template <std::size_t Size>
double* JointProblem::store(const std::array<double, Size>& values) {
  LIGHTSTRIPE_CHECK(storage_.size() + Size <= storage_.capacity(), "blocks must not move");
  storage_.insert(storage_.end(), values.begin(), values.end());
  return storage_.data() + (storage_.size() - Size);
}

void JointProblem::store_state(const RigState& state) {
  std::size_t size = 29 + 7 * state.first_from_board.size();
  for (const auto& sensor : state.sensors) size += kIntrinsics + 7 + 4 * sensor.laser_planes.size();
  storage_.reserve(size);
  for (const auto& sensor : state.sensors) {
    intrinsics_.push_back(store(intrinsics_block_of(sensor.camera)));
    cam_from_first_.push_back(store(pose_block_of(sensor.cam_from_first)));
    planes_.emplace_back();
    for (const auto& plane : sensor.laser_planes) planes_.back().push_back(store(plane_block_of(plane)));
  }
  for (const auto& pose : state.first_from_board) first_from_board_.push_back(store(pose_block_of(pose)));
  warp_ = store(std::array<double, 2>{state.board_warp_mm.x(), state.board_warp_mm.y()});
  if (state.motion) {
    motion_board_ = store(pose_block_of(state.motion->first_from_board));
    direction_ = store(block_of(state.motion->direction));
    axis_point_ = store(block_of(state.motion->axis_point));
  }
  if (state.tool) {
    tool_from_first_ = store(pose_block_of(state.tool->tool_from_first));
    base_from_board_ = store(pose_block_of(state.tool->base_from_board));
  }
}

void JointProblem::add_global(GlobalBlock block, double* data, ceres::Manifold* manifold) {
  problem_->AddParameterBlock(data, manifold->AmbientSize(), manifold);
  block.column = num_globals();
  block.size = manifold->TangentSize();
  globals_.push_back(block);
  global_blocks_.push_back(data);
}

void JointProblem::add_constant(double* data, int size) {
  problem_->AddParameterBlock(data, size);
  problem_->SetParameterBlockConstant(data);
}

void JointProblem::add_sensor_blocks(std::size_t s) {
  using Kind = GlobalBlock::Kind;
  const int sensor = static_cast<int>(s);
  const auto& given = session_->given_cameras[s];
  if (given && given->fixed) {
    add_constant(intrinsics_[s], kIntrinsics);
  } else {
    const LensModel lens = options_.lenses.at(s);
    add_global({Kind::kIntrinsics, sensor, 0, 0, 0, lens}, intrinsics_[s], intrinsics_manifold(lens));
  }
  if (s == 0) {
    add_constant(cam_from_first_[s], 7);
  } else {
    add_global({Kind::kCamFromFirst, sensor}, cam_from_first_[s], new PoseManifold);
  }
  for (std::size_t p = 0; p < planes_[s].size(); ++p)
    add_global({Kind::kLaserPlane, sensor, static_cast<int>(p)}, planes_[s][p], new PlaneManifold);
}

void JointProblem::add_motion_blocks() {
  using Kind = GlobalBlock::Kind;
  if (!start_.motion) return;
  add_global({Kind::kDirection}, direction_, new ceres::SphereManifold<3>);
  if (session_->motion == MotionType::kRotary) {
    add_global({Kind::kAxisPoint}, axis_point_, axis_point_manifold(start_.motion->direction));
  } else {
    add_constant(axis_point_, 3);
  }
}

void JointProblem::add_blocks(const std::vector<Residual>& list) {
  for (std::size_t s = 0; s < intrinsics_.size(); ++s) add_sensor_blocks(s);
  if (options_.board_warp) {
    add_global({GlobalBlock::Kind::kBoardWarp}, warp_, new ceres::EuclideanManifold<2>);
  } else {
    add_constant(warp_, 2);
  }
  add_motion_blocks();
  if (start_.tool) {
    add_global({GlobalBlock::Kind::kToolFromFirst}, tool_from_first_, new PoseManifold);
    add_global({GlobalBlock::Kind::kBaseFromBoard}, base_from_board_, new PoseManifold);
  }
  for (const auto& residual : list) {
    double* block = pose_block(session_->views[residual.view]);
    if (!residual.used || problem_->HasParameterBlock(block)) continue;
    problem_->AddParameterBlock(block, 7, new PoseManifold);
    pose_blocks_.push_back(block);
  }
}

void JointProblem::add_tool() {
  for (const auto& measured : options_.tool_poses) {
    double* board = first_from_board_.at(measured.pose);
    tool_residuals_.push_back(nullptr);
    if (!problem_->HasParameterBlock(board)) continue;
    auto* error = new ToolPoseError{measured.base_from_tool.inverse(), options_.tool_spread};
    tool_residuals_.back() = problem_->AddResidualBlock(
        new ToolPoseResidual(error),
        options_.robust_tool ? new ceres::CauchyLoss(options_.robust_scale) : nullptr, board,
        tool_from_first_, base_from_board_);
  }
}

double* JointProblem::pose_block(const SessionView& view) {
  return view.pose < 0 ? motion_board_ : first_from_board_[static_cast<std::size_t>(view.pose)];
}

ceres::LossFunction* JointProblem::loss() const {
  using Loss = ProblemOptions::Loss;
  if (options_.loss == Loss::kHuber) return new ceres::HuberLoss(options_.robust_scale);
  if (options_.loss == Loss::kCauchy) return new ceres::CauchyLoss(options_.robust_scale);
  return nullptr;
}

void JointProblem::add_corner(const SessionView& view, const Residual& residual) {
  const auto sensor = static_cast<std::size_t>(view.sensor);
  const auto& target = session_->target;
  const BoardPlace corner = board_place(target, target.corner(static_cast<int>(residual.index)));
  const Eigen::Vector2d& pixel = view.corners[residual.index];
  double* intrinsics = intrinsics_[sensor];
  double* cam_from_first = cam_from_first_[sensor];
  if (view.pose >= 0) {
    problem_->AddResidualBlock(new CornerResidual(corner, pixel, residual.sigma_px), loss(), intrinsics,
                               cam_from_first, pose_block(view), warp_);
    return;
  }
  const double signed_travel = session_->motion_sign() * view.travel;
  problem_->AddResidualBlock(
      new TravelCornerResidual(corner, pixel, residual.sigma_px, session_->motion, signed_travel), loss(),
      intrinsics, cam_from_first, pose_block(view), warp_, direction_, axis_point_);
}

void JointProblem::add_stripe_point(const SessionView& view, const Residual& residual) {
  const auto s = static_cast<std::size_t>(view.sensor);
  const auto p = static_cast<std::size_t>(residual.plane);
  const auto& point = view.stripes[p][residual.index];
  const auto seen = seen_stripe_point(*session_, start_, view, p, {point.x, point.y});
  LIGHTSTRIPE_CHECK(seen.has_value(), "a stripe point that no ray explains must not be used");
  problem_->AddResidualBlock(new StripeResidual(seen->place, {point.x, point.y}, seen->frame.normal,
                                                seen->frame.across, residual.sigma_px),
                             loss(), intrinsics_[s], cam_from_first_[s], pose_block(view), warp_,
                             planes_[s][p]);
}

std::optional<SeenStripePoint> seen_stripe_point(const SessionViews& session, const RigState& state,
                                                 const SessionView& view, std::size_t plane,
                                                 const Eigen::Vector2d& pixel) {
  const auto& sensor = state.sensors[static_cast<std::size_t>(view.sensor)];
  const Rigid3 cam_from_board =
      sensor.cam_from_first * state.first_from_board[static_cast<std::size_t>(view.pose)];
  const auto place = view.height_mm ? seen_place_on_top(sensor.camera, cam_from_board, *view.height_mm, pixel)
                                    : seen_place(session.target, sensor.camera, cam_from_board, pixel);
  if (!place) return std::nullopt;
  const auto frame =
      stripe_crossing(sensor.camera, tangent_plane(*place, state.board_warp_mm, cam_from_board),
                      sensor.laser_planes[plane], pixel);
  if (!frame) return std::nullopt;
  return SeenStripePoint{*place, *frame};
}

RigState JointProblem::state() const {
  RigState result = start_;
  for (std::size_t s = 0; s < result.sensors.size(); ++s) {
    result.sensors[s].camera = camera_of(start_.sensors[s].camera, intrinsics_[s]);
    result.sensors[s].cam_from_first = pose_of(cam_from_first_[s]);
    for (std::size_t p = 0; p < planes_[s].size(); ++p)
      result.sensors[s].laser_planes[p] = plane_of(planes_[s][p]);
  }
  for (std::size_t i = 0; i < first_from_board_.size(); ++i)
    result.first_from_board[i] = pose_of(first_from_board_[i]);
  result.board_warp_mm = Eigen::Map<const Eigen::Vector2d>(warp_);
  if (result.motion) {
    result.motion->first_from_board = pose_of(motion_board_);
    result.motion->direction = Eigen::Map<const Eigen::Vector3d>(direction_).normalized();
    result.motion->axis_point = Eigen::Map<const Eigen::Vector3d>(axis_point_);
  }
  if (result.tool) result.tool = {pose_of(tool_from_first_), pose_of(base_from_board_)};
  return result;
}

std::vector<double*> JointProblem::blocks() const {
  std::vector<double*> all = global_blocks_;
  all.insert(all.end(), pose_blocks_.begin(), pose_blocks_.end());
  return all;
}

RigState moved_state(const RigState& state, const std::vector<GlobalBlock>& globals,
                     const Eigen::VectorXd& delta) {
  using Kind = GlobalBlock::Kind;
  const auto move_pose = [](Rigid3& pose, const double* step) {
    auto from = pose_block_of(pose), to = from;
    PoseManifold().Plus(from.data(), step, to.data());
    pose = pose_of(to.data());
  };
  RigState result = state;
  for (const auto& block : globals) {
    const double* step = delta.data() + block.column;
    if (Eigen::Map<const Eigen::VectorXd>(step, block.size).isZero(0)) continue;
    auto& sensor = result.sensors[static_cast<std::size_t>(block.sensor)];
    if (block.kind == Kind::kIntrinsics) {
      auto from = intrinsics_block_of(sensor.camera), to = from;
      std::unique_ptr<ceres::Manifold>(intrinsics_manifold(block.lens))->Plus(from.data(), step, to.data());
      sensor.camera = camera_of(sensor.camera, to.data());
    } else if (block.kind == Kind::kCamFromFirst) {
      move_pose(sensor.cam_from_first, step);
    } else if (block.kind == Kind::kLaserPlane) {
      auto& plane = sensor.laser_planes[static_cast<std::size_t>(block.plane)];
      auto from = plane_block_of(plane), to = from;
      PlaneManifold().Plus(from.data(), step, to.data());
      plane = plane_of(to.data());
    } else if (block.kind == Kind::kBoardWarp) {
      result.board_warp_mm += Eigen::Map<const Eigen::Vector2d>(step);
    } else if (block.kind == Kind::kToolFromFirst) {
      move_pose(result.tool->tool_from_first, step);
    } else if (block.kind == Kind::kBaseFromBoard) {
      move_pose(result.tool->base_from_board, step);
    } else if (block.kind == Kind::kDirection) {
      const auto from = block_of(state.motion->direction);
      ceres::SphereManifold<3>().Plus(from.data(), step, result.motion->direction.data());
    } else {
      auto from = block_of(state.motion->axis_point), to = from;
      std::unique_ptr<ceres::Manifold>(axis_point_manifold(state.motion->direction))
          ->Plus(from.data(), step, to.data());
      result.motion->axis_point = {to[0], to[1], to[2]};
    }
  }
  return result;
}

}  // namespace lightstripe
