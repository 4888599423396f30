// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The three measurements of the joint adjustment as Ceres cost functions, in units of their standard
// deviation. Parameter blocks:
//   intrinsics (18)  fx fy cx cy, then OpenCV's 14 distortion terms; a manifold says which of them are free
//   pose (7)         quaternion x y z w (Eigen's order), translation in mm
//   plane (4)        unit normal, offset in mm; camera frame
//   warp (2)         of the board, mm (see board_surface.h)
//   direction (3)    unit; axis_point (3) in mm; first sensor's frame
// Derivatives by the chain rule; one compiled function serves every distortion model.
#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "calib/adjust/board_surface.h"
#include "core/camera.h"
#include "core/rig.h"

namespace lightstripe {

inline constexpr int kIntrinsics = 4 + kDistortionTerms;

struct ProjectionDerivatives {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_point;  ///< px / mm
  Eigen::Matrix<double, 2, kIntrinsics, Eigen::RowMajor> by_intrinsics;
};

/// The pixel of a point in front of the camera, with its derivatives.
ProjectionDerivatives project_with_derivatives(const double* intrinsics, const Eigen::Vector3d& p_cam);

/// A board corner: reprojection error in x and y. Blocks: intrinsics, cam_from_first, first_from_board,
/// warp.
class CornerResidual final : public ceres::SizedCostFunction<2, kIntrinsics, 7, 7, 2> {
 public:
  CornerResidual(const BoardPlace& corner, const Eigen::Vector2d& pixel, double sigma_px)
      : corner_(corner), pixel_(pixel), sigma_px_(sigma_px) {}
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override;

 private:
  BoardPlace corner_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

/// A corner of the fixed board seen at a known travel: p_seen = p + s * direction, or turned by s about the
/// axis. Blocks: intrinsics, cam_from_first, first_from_board (at travel 0), warp, direction, axis_point.
class TravelCornerResidual final : public ceres::SizedCostFunction<2, kIntrinsics, 7, 7, 2, 3, 3> {
 public:
  /// `signed_travel` in mm, or radians: SessionViews::motion_sign() times the travel.
  TravelCornerResidual(const BoardPlace& corner, const Eigen::Vector2d& pixel, double sigma_px,
                       MotionType motion, double signed_travel)
      : corner_(corner), pixel_(pixel), sigma_px_(sigma_px), motion_(motion), signed_travel_(signed_travel) {}
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override;

 private:
  BoardPlace corner_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
  MotionType motion_;
  double signed_travel_;
};

/// A stripe point: its distance in the image to the projection of the line "board meets laser plane", across
/// that line. The board is the plane that touches its warped surface at `place`, next to the point. Of the
/// line in space, the point is taken where it meets the plane through the projection centre that the pixel
/// and the image normal span. `normal` and `across` (see StripeCrossing) are constants of one solve, computed
/// at its start: an error in them moves the chosen point along the line only, which changes the residual to
/// second order. Blocks: intrinsics, cam_from_first, first_from_board, warp, plane.
class StripeResidual final : public ceres::SizedCostFunction<1, kIntrinsics, 7, 7, 2, 4> {
 public:
  StripeResidual(const BoardPlace& place, const Eigen::Vector2d& pixel, const Eigen::Vector2d& normal,
                 const Eigen::Vector3d& across, double sigma_px)
      : place_(place), pixel_(pixel), normal_(normal), across_(across), sigma_px_(sigma_px) {}
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override;

 private:
  BoardPlace place_;
  Eigen::Vector2d pixel_, normal_;
  Eigen::Vector3d across_;
  double sigma_px_;
};

/// Keeps the terms of a rich lens model that the views leave open at sizes that lenses have: each divided by
/// a sigma of 5. Block: intrinsics. Residuals of the other terms are 0.
class LensPrior final : public ceres::SizedCostFunction<kDistortionTerms, kIntrinsics> {
 public:
  explicit LensPrior(std::vector<int> terms) : terms_(std::move(terms)) {}
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override;

 private:
  std::vector<int> terms_;
};

}  // namespace lightstripe
