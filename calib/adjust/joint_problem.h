// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The joint adjustment as a Ceres problem: blocks of unknowns, one residual block a measurement.
#pragma once

#include <ceres/problem.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "calib/adjust/board_surface.h"
#include "calib/adjust/lens_model.h"
#include "calib/adjust/rig_state.h"
#include "calib/adjust/stripe_crossing.h"
#include "calib/adjust/tool_pose_error.h"

namespace lightstripe {

/// One corner or stripe point in the adjustment.
struct Residual {
  std::size_t view = 0;
  int plane = -1;         ///< -1: a corner
  std::size_t index = 0;  ///< of the corner, or of the stripe's point
  double sigma_px = 1;
  bool used = true;
  Eigen::Vector2d residual_px =
      Eigen::Vector2d::Zero();  ///< at the end of the solve; a stripe point uses x only

  bool is_corner() const { return plane < 0; }
  int dimension() const { return is_corner() ? 2 : 1; }
  double normalised() const { return residual_px.norm() / sigma_px; }
};

/// Unknowns that all views share; a view's pose is not one of them.
struct GlobalBlock {
  enum class Kind {
    kIntrinsics,
    kCamFromFirst,
    kLaserPlane,
    kBoardWarp,
    kDirection,
    kAxisPoint,
    kToolFromFirst,
    kBaseFromBoard
  };
  Kind kind = Kind::kIntrinsics;
  int sensor = 0, plane = 0;
  int column = 0, size = 0;  ///< place in the covariance: first column and number of columns (tangent space)
  LensModel lens = LensModel::kAuto;  ///< of kIntrinsics
};

/// The tool's pose beside one board pose.
struct ToolMeasurement {
  std::size_t pose = 0;  ///< of SessionViews::poses
  Rigid3 base_from_tool;
};

struct ProblemOptions {
  std::vector<LensModel> lenses;  ///< for each sensor; cameras that are given and fixed keep theirs
  bool board_warp = true;         ///< false: the board keeps the state's warp
  enum class Loss { kSquared, kHuber, kCauchy } loss = Loss::kSquared;
  double robust_scale = 3;                    ///< of the loss, in sigma
  std::vector<ToolMeasurement> tool_poses{};  ///< of a state that has a tool
  ToolSpread tool_spread{};
  bool robust_tool = false;  ///< Cauchy's loss on the tool's poses
};

/// Owns the unknowns while Ceres works on them. SessionViews that are not `used` are left out; the constants
/// of the stripe residuals (see StripeResidual) are those of the state given.
class JointProblem {
 public:
  JointProblem(const SessionViews& session, const RigState& state, const std::vector<Residual>& list,
               const ProblemOptions& options);

  JointProblem(const JointProblem&) = delete;  // blocks are known by their addresses
  JointProblem& operator=(const JointProblem&) = delete;

  ceres::Problem& problem() { return *problem_; }
  RigState state() const;
  /// Shared unknowns in the order of the covariance.
  const std::vector<GlobalBlock>& globals() const { return globals_; }
  int num_globals() const { return globals_.empty() ? 0 : globals_.back().column + globals_.back().size; }
  /// The parameter blocks, shared ones first in the order of globals(), then the poses that a view uses.
  std::vector<double*> blocks() const;
  /// The poses' blocks: eliminated first.
  const std::vector<double*>& pose_blocks() const { return pose_blocks_; }
  /// For each of the options' tool poses; null where no used view shows its board.
  const std::vector<ceres::ResidualBlockId>& tool_residuals() const { return tool_residuals_; }

 private:
  void add_corner(const SessionView& view, const Residual& residual);
  void add_stripe_point(const SessionView& view, const Residual& residual);
  template <std::size_t Size>
  double* store(const std::array<double, Size>& values);
  void store_state(const RigState& state);
  void add_blocks(const std::vector<Residual>& list);
  void add_sensor_blocks(std::size_t sensor);
  void add_motion_blocks();
  void add_tool();
  void add_constant(double* data, int size);
  void add_global(GlobalBlock block, double* data, ceres::Manifold* manifold);
  double* pose_block(const SessionView& view);
  ceres::LossFunction* loss() const;

  const SessionViews* session_;
  RigState start_;
  ProblemOptions options_;
  /// All unknowns in one array: Ceres orders blocks by address, and sums in that order.
  std::vector<double> storage_;
  std::vector<double*> intrinsics_, cam_from_first_, first_from_board_;
  std::vector<std::vector<double*>> planes_;
  double* warp_ = nullptr;
  double *motion_board_ = nullptr, *direction_ = nullptr, *axis_point_ = nullptr;
  double *tool_from_first_ = nullptr, *base_from_board_ = nullptr;
  std::vector<GlobalBlock> globals_;
  std::vector<double*> global_blocks_, pose_blocks_;
  std::vector<ceres::ResidualBlockId> tool_residuals_;
  std::unique_ptr<ceres::Problem> problem_;
};

/// A stripe point's place on the board and the frame of its residual.
struct SeenStripePoint {
  BoardPlace place;
  StripeCrossing frame;
};

/// Nothing where no ray of this state explains the point.
std::optional<SeenStripePoint> seen_stripe_point(const SessionViews& session, const RigState& state,
                                                 const SessionView& view, std::size_t plane,
                                                 const Eigen::Vector2d& pixel);

/// The state moved by `delta` in the tangent space of its shared unknowns: what column j of the covariance
/// means.
RigState moved_state(const RigState& state, const std::vector<GlobalBlock>& globals,
                     const Eigen::VectorXd& delta);

}  // namespace lightstripe
