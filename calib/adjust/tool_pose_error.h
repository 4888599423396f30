// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a robot's controller says of its tool against where the fixed board shows it.
#pragma once

#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/transform.h"

namespace lightstripe {

/// Spread of the poses' errors: rotation (rad) and translation (mm), each component.
struct ToolSpread {
  double rotation = 1e-3, translation = 0.5;
};

/// The turn (2 x vector part of the quaternion, about the rotation vector for small angles) and the shift of
/// base_from_tool^-1 base_from_board board_from_first first_from_tool, which is the identity without error,
/// in units of their spread. Blocks, poses as in residuals.h: first_from_board, tool_from_first,
/// base_from_board.
struct ToolPoseError {
  Rigid3 tool_from_base;
  ToolSpread spread;

  template <class T>
  bool operator()(const T* first_from_board, const T* tool_from_first, const T* base_from_board,
                  T* residual) const {
    using Quaternion = Eigen::Quaternion<T>;
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Quaternion> q_board(first_from_board), q_first(tool_from_first),
        q_base(base_from_board);
    const Eigen::Map<const Vector> t_board(first_from_board + 4), t_first(tool_from_first + 4),
        t_base(base_from_board + 4);
    const Vector tool_in_first = -(q_first.conjugate() * t_first);
    const Vector tool_in_base = q_base * (q_board.conjugate() * (tool_in_first - t_board)) + t_base;
    const Quaternion q_tool = tool_from_base.rotation.cast<T>();
    const Vector t = q_tool * tool_in_base + tool_from_base.translation.cast<T>();
    const Quaternion q = q_tool * q_base * q_board.conjugate() * q_first.conjugate();
    const T twice = q.w() < T(0) ? T(-2) : T(2);
    for (int i = 0; i < 3; ++i) {
      residual[i] = twice * q.vec()[i] / T(spread.rotation);
      residual[3 + i] = t[i] / T(spread.translation);
    }
    return true;
  }
};

using ToolPoseResidual = ceres::AutoDiffCostFunction<ToolPoseError, 6, 7, 7, 7>;

}  // namespace lightstripe
