// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The three measurements of the joint adjustment as Ceres cost functions, in units of their standard
// deviation. Parameter blocks:
//   intrinsics (18)  fx fy cx cy, then OpenCV's 14 distortion terms; a manifold says which of them are free
//   pose (7)         quaternion x y z w (Eigen's order), translation in mm
//   plane (4)        unit normal, offset in mm; camera frame
//   direction (3)    unit; axis_point (3) in mm; first sensor's frame
// Derivatives by the chain rule: only the camera model is differentiated automatically, so that one compiled
// function serves every distortion model.
#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

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

/// A board corner: reprojection error in x and y. Blocks: intrinsics, cam_from_first, first_from_board.
class CornerResidual final : public ceres::SizedCostFunction<2, kIntrinsics, 7, 7> {
 public:
  CornerResidual(const Eigen::Vector3d& p_board, const Eigen::Vector2d& pixel, double sigma_px)
      : p_board_(p_board), pixel_(pixel), sigma_px_(sigma_px) {}
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override;

 private:
  Eigen::Vector3d p_board_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

/// A corner of the fixed board seen at a known travel: p_seen = p + s * direction, or turned by s about the
/// axis. Blocks: intrinsics, cam_from_first, first_from_board (at travel 0), direction, axis_point.
class TravelCornerResidual final : public ceres::SizedCostFunction<2, kIntrinsics, 7, 7, 3, 3> {
 public:
  /// `signed_travel` in mm, or radians: Measurements::motion_sign() times the travel.
  TravelCornerResidual(const Eigen::Vector3d& p_board, const Eigen::Vector2d& pixel, double sigma_px,
                       MotionType motion, double signed_travel)
      : p_board_(p_board),
        pixel_(pixel),
        sigma_px_(sigma_px),
        motion_(motion),
        signed_travel_(signed_travel) {}
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override;

 private:
  Eigen::Vector3d p_board_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
  MotionType motion_;
  double signed_travel_;
};

/// A stripe point: its distance in the image to the projection of the line "board meets laser plane", across
/// that line. Of the line in space, the point is taken where it meets the plane through the projection centre
/// that the pixel and the image normal span. `normal` and `across` (see StripeFrame) are constants of one
/// solve, computed at its start: an error in them moves the chosen point along the line only, which changes
/// the residual to second order. Blocks: intrinsics, cam_from_first, first_from_board, plane.
class StripeResidual final : public ceres::SizedCostFunction<1, kIntrinsics, 7, 7, 4> {
 public:
  StripeResidual(const Eigen::Vector2d& pixel, const Eigen::Vector2d& normal, const Eigen::Vector3d& across,
                 double sigma_px)
      : pixel_(pixel), normal_(normal), across_(across), sigma_px_(sigma_px) {}
  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override;

 private:
  Eigen::Vector2d pixel_, normal_;
  Eigen::Vector3d across_;
  double sigma_px_;
};

}  // namespace lightstripe
