// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/hand_eye.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/product_manifold.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "calib/adjust/parameter_blocks.h"
#include "calib/adjust/rig_state.h"
#include "calib/adjust/tool_pose_error.h"
#include "core/counted.h"
#include "core/linear_algebra.h"
#include "core/robust.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kMinPoses = 5;

struct Block {
  PoseBlock values;

  explicit Block(const Rigid3& pose) : values(pose_block_of(pose)) {}
  Rigid3 pose() const { return pose_of(values.data()); }
};

Vector6d error_of(const ToolView& view, const Block& tool, const Block& base) {
  Vector6d error;
  ToolPoseError{view.base_from_tool.inverse(), {1, 1}}(Block(view.first_from_board).values.data(),
                                                       tool.values.data(), base.values.data(), error.data());
  return error;
}

cv::Mat as_mat(const Matrix3d& R) {
  cv::Mat m(3, 3, CV_64F);
  for (int i = 0; i < 9; ++i) m.at<double>(i / 3, i % 3) = R(i / 3, i % 3);
  return m;
}

Rigid3 start_value(const std::vector<ToolView>& views, cv::HandEyeCalibrationMethod method) {
  std::vector<cv::Mat> R_tool, t_tool, R_board, t_board;
  for (const auto& view : views) {
    R_tool.push_back(as_mat(view.base_from_tool.rotation.toRotationMatrix()));
    R_board.push_back(as_mat(view.first_from_board.rotation.toRotationMatrix()));
    const Vector3d &a = view.base_from_tool.translation, &b = view.first_from_board.translation;
    t_tool.push_back((cv::Mat_<double>(3, 1) << a.x(), a.y(), a.z()));
    t_board.push_back((cv::Mat_<double>(3, 1) << b.x(), b.y(), b.z()));
  }
  cv::Mat R, t;
  cv::calibrateHandEye(R_tool, t_tool, R_board, t_board, R, t, method);
  Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = R.at<double>(i / 3, i % 3);
  return {Eigen::Quaterniond(rotation).normalized(), {t.at<double>(0), t.at<double>(1), t.at<double>(2)}};
}

/// Solves with these weights from where the blocks are.
void solve(const std::vector<ToolView>& views, const std::vector<bool>& used, const ToolSpread& spread,
           bool robust, Block& tool, Block& base) {
  ceres::Problem problem;
  problem.AddParameterBlock(tool.values.data(), 7, new PoseManifold);
  problem.AddParameterBlock(base.values.data(), 7, new PoseManifold);
  std::vector<Block> boards;
  boards.reserve(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!used[i]) continue;
    double* board = boards.emplace_back(views[i].first_from_board).values.data();
    problem.AddResidualBlock(
        new ToolPoseResidual(new ToolPoseError{views[i].base_from_tool.inverse(), spread}),
        robust ? new ceres::CauchyLoss(3) : nullptr, board, tool.values.data(), base.values.data());
    problem.SetParameterBlockConstant(board);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  options.function_tolerance = 1e-12;
  options.max_num_iterations = 100;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}

/// Of the components: robust, or rms with the unknowns (12 of 6 n) allowed for.
ToolSpread spread_of(const std::vector<ToolView>& views, const std::vector<bool>& used, const Block& tool,
                     const Block& base, bool robust) {
  std::vector<double> turns, shifts;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!used[i]) continue;
    const Vector6d e = error_of(views[i], tool, base);
    for (int k = 0; k < 3; ++k) turns.push_back(std::abs(e[k])), shifts.push_back(std::abs(e[3 + k]));
  }
  const double n = static_cast<double>(turns.size());
  const double redundancy = std::max(0.1, 1 - 12 / (2 * n));
  const auto rms = [&](const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v * v;
    return std::sqrt(sum / n / redundancy);
  };
  return {std::max(1e-7, robust ? kMadToSigma * upper_median(turns) : rms(turns)),
          std::max(1e-4, robust ? kMadToSigma * upper_median(shifts) : rms(shifts))};
}

void refuse_standing_tool(const std::vector<ToolView>& views) {
  constexpr double kMinTurn = 5 * kDegree;
  if (views.size() < kMinPoses)
    throw NotUsable(
        fmt::format("motion: the board was found in {} with a pose of the tool; at least {} are "
                    "needed, better 20",
                    counted(views.size(), "picture"), kMinPoses));
  Matrix3d axes = Matrix3d::Zero();
  double largest = 0;
  for (const auto& view : views) {
    const Eigen::AngleAxisd turn(views.front().base_from_tool.rotation.conjugate() *
                                 view.base_from_tool.rotation);
    largest = std::max(largest, std::abs(turn.angle()));
    axes += turn.angle() * turn.angle() * turn.axis() * turn.axis().transpose();
  }
  if (largest < kMinTurn)
    throw NotUsable(
        fmt::format("motion: the tool's poses do not move: they turn by {:.2f} degrees at most; give each "
                    "picture its own pose (base_from_tool), turned by 20 to 60 degrees about different axes",
                    largest / kDegree));
  const Eigen::VectorXd spread = symmetric_eigen(axes).values;
  if (spread[1] < 0.01 * spread[2])
    throw NotUsable(
        "motion: the tool turns about one axis only, which leaves its distance to the rig along "
        "that axis open; turn it about a second axis as well");
}

void refuse_contradiction(const HandEye& found, std::size_t used, std::size_t all) {
  constexpr double kMaxDeg = 1.5, kMaxMm = 8;
  if (found.rotation_rms_deg < kMaxDeg && found.translation_rms_mm < kMaxMm && 2 * used > all) return;
  throw NotUsable(fmt::format(
      "motion: the tool's poses contradict the board's by {:.2f} degrees and {:.1f} mm ({} of {} "
      "fit); check that poses are base_from_tool in mm with quaternions w x y z, each beside its own "
      "picture, and that the board is fixed",
      found.rotation_rms_deg, found.translation_rms_mm, used, all));
}

/// Of the two closed forms the better one.
Rigid3 best_start(const std::vector<ToolView>& views) {
  Rigid3 best;
  double least = 1e300;
  for (const auto method : {cv::CALIB_HAND_EYE_DANIILIDIS, cv::CALIB_HAND_EYE_TSAI}) {
    const Rigid3 start = start_value(views, method);
    const Rigid3 base_from_board = views.front().base_from_tool * start * views.front().first_from_board;
    std::vector<double> errors;
    for (const auto& view : views)
      errors.push_back(error_of(view, Block(start), Block(base_from_board)).tail<3>().norm());
    const double error = upper_median(errors);
    if (!(error < least)) continue;
    least = error;
    best = start;
  }
  return best;
}

}  // namespace

HandEye find_hand_eye(const std::vector<ToolView>& views) {
  constexpr double kOutlier = 4.5;  // in sigma of a component
  refuse_standing_tool(views);
  Block tool(best_start(views));
  Block base(views.front().base_from_tool * tool.pose() * views.front().first_from_board);
  std::vector<bool> used(views.size(), true);
  ToolSpread spread;
  for (int round = 0; round < 3; ++round) {
    solve(views, used, spread, true, tool, base);
    spread = spread_of(views, used, tool, base, true);
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Vector6d e = error_of(views[i], tool, base);
    used[i] = e.head<3>().norm() < kOutlier * std::sqrt(3.0) * spread.rotation &&
              e.tail<3>().norm() < kOutlier * std::sqrt(3.0) * spread.translation;
  }
  for (int round = 0; round < 2; ++round) {
    solve(views, used, spread, false, tool, base);
    spread = spread_of(views, used, tool, base, false);
  }
  HandEye result;
  result.tool_from_first = tool.pose();
  result.base_from_board = base.pose();
  result.spread = spread;
  result.rotation_rms_deg = std::sqrt(3.0) * spread.rotation / kDegree;
  result.translation_rms_mm = std::sqrt(3.0) * spread.translation;
  refuse_contradiction(result, static_cast<std::size_t>(std::count(used.begin(), used.end(), true)),
                       views.size());
  return result;
}

}  // namespace lightstripe
