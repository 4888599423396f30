// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The three measurements of the joint adjustment as Ceres functors, in units of their standard deviation.
// Parameter blocks:
//   intrinsics       fx fy cx cy and the first Terms of OpenCV's distortion
//   pose (7)         quaternion x y z w (Eigen's order), translation in mm
//   plane (4)        unit normal, offset in mm; camera frame
//   direction (3)    unit; axis_point (3) in mm; first sensor's frame
#pragma once

#include <ceres/autodiff_cost_function.h>
#include <ceres/rotation.h>

#include <Eigen/Geometry>

#include "core/camera.h"
#include "core/rig.h"

namespace lightstripe {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

template <class T>
Vector3<T> transformed(const T* pose, const Vector3<T>& p) {
  const Eigen::Map<const Eigen::Quaternion<T>> rotation(pose);
  const Eigen::Map<const Vector3<T>> translation(pose + 4);
  return rotation * p + translation;
}

template <int Terms, class T>
Eigen::Matrix<T, 2, 1> pixel_of(const T* intrinsics, const Vector3<T>& p_cam) {
  T distortion[kDistortionTerms];
  for (int i = 0; i < kDistortionTerms; ++i) distortion[i] = i < Terms ? intrinsics[4 + i] : T(0);
  return project<T>(intrinsics, distortion, p_cam);
}

/// A board corner: reprojection error in x and y.
template <int Terms>
struct CornerResidual {
  Eigen::Vector3d p_board;
  Eigen::Vector2d pixel;
  double sigma_px;

  template <class T>
  bool operator()(const T* intrinsics, const T* cam_from_first, const T* first_from_board, T* residual) const {
    const Vector3<T> p_first = transformed<T>(first_from_board, p_board.cast<T>());
    const Vector3<T> p_cam = transformed<T>(cam_from_first, p_first);
    if (!(p_cam.z() > T(0))) return false;
    const Eigen::Matrix<T, 2, 1> seen = pixel_of<Terms, T>(intrinsics, p_cam);
    residual[0] = (seen.x() - pixel.x()) / sigma_px;
    residual[1] = (seen.y() - pixel.y()) / sigma_px;
    return true;
  }

  static ceres::CostFunction* create(const CornerResidual& functor) {
    return new ceres::AutoDiffCostFunction<CornerResidual, 2, 4 + Terms, 7, 7>(new CornerResidual(functor));
  }
};

/// A corner of the fixed board seen at a known travel: p_seen = p + s * direction, or turned by s about the axis.
template <int Terms>
struct TravelCornerResidual {
  CornerResidual<Terms> corner;
  MotionType motion;
  double signed_travel;  ///< mm, or radians

  template <class T>
  bool operator()(const T* intrinsics, const T* cam_from_first, const T* first_from_board, const T* direction,
                  const T* axis_point, T* residual) const {
    Vector3<T> p = transformed<T>(first_from_board, corner.p_board.cast<T>());
    const Eigen::Map<const Vector3<T>> axis(direction), point(axis_point);
    if (motion == MotionType::kRotary) {
      const Vector3<T> angle_axis = T(signed_travel) * axis, from_axis = p - point;
      ceres::AngleAxisRotatePoint(angle_axis.data(), from_axis.data(), p.data());
      p += point;
    } else {
      p += T(signed_travel) * axis;
    }
    const Vector3<T> p_cam = transformed<T>(cam_from_first, p);
    if (!(p_cam.z() > T(0))) return false;
    const Eigen::Matrix<T, 2, 1> seen = pixel_of<Terms, T>(intrinsics, p_cam);
    residual[0] = (seen.x() - corner.pixel.x()) / corner.sigma_px;
    residual[1] = (seen.y() - corner.pixel.y()) / corner.sigma_px;
    return true;
  }

  static ceres::CostFunction* create(const TravelCornerResidual& functor) {
    return new ceres::AutoDiffCostFunction<TravelCornerResidual, 2, 4 + Terms, 7, 7, 3, 3>(
        new TravelCornerResidual(functor));
  }
};

/// A stripe point: its distance in the image to the projection of the line "board meets laser plane", across that line.
/// Of the line in space, the point is taken where it meets the plane through the projection centre that the pixel and
/// the image normal span. `normal` and `across` are constants of one solve, computed at its start: an error in them
/// moves the chosen point along the line only, which changes the residual to second order.
template <int Terms>
struct StripeResidual {
  Eigen::Vector2d pixel;   ///< observed centre
  Eigen::Vector2d normal;  ///< unit, across the projected line at the pixel
  Eigen::Vector3d across;  ///< normal of the plane through the projection centre, the pixel's ray and `normal`; camera frame
  double sigma_px;

  template <class T>
  bool operator()(const T* intrinsics, const T* cam_from_first, const T* first_from_board, const T* plane,
                  T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> cam_q(cam_from_first), board_q(first_from_board);
    const Vector3<T> z_first = board_q * Vector3<T>(T(0), T(0), T(1));
    const Vector3<T> n_board = cam_q * z_first;
    const Vector3<T> origin = transformed<T>(cam_from_first, Vector3<T>(Eigen::Map<const Vector3<T>>(first_from_board + 4)));
    const T d_board = n_board.dot(origin);
    const Vector3<T> n_laser = Eigen::Map<const Vector3<T>>(plane);
    const Vector3<T> m = across.cast<T>();
    // Cramer's rule for n_board.X = d_board, n_laser.X = d_laser, m.X = 0.
    const Vector3<T> laser_x_m = n_laser.cross(m), m_x_board = m.cross(n_board);
    const Vector3<T> p_cam = (d_board * laser_x_m + plane[3] * m_x_board) / n_board.dot(laser_x_m);
    if (!(p_cam.z() > T(0))) return false;
    const Eigen::Matrix<T, 2, 1> seen = pixel_of<Terms, T>(intrinsics, p_cam);
    residual[0] = (normal.x() * (seen.x() - pixel.x()) + normal.y() * (seen.y() - pixel.y())) / sigma_px;
    return true;
  }

  static ceres::CostFunction* create(const StripeResidual& functor) {
    return new ceres::AutoDiffCostFunction<StripeResidual, 1, 4 + Terms, 7, 7, 4>(new StripeResidual(functor));
  }
};

}  // namespace lightstripe
