// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/residuals.h"

#include <ceres/jet.h>
#include <ceres/rotation.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
template <int Rows, int Columns>
using RowMajor = Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>;
using Matrix34 = RowMajor<3, 4>;

/// A parameter block of a pose, and what it does to a point.
struct Pose {
  Eigen::Quaterniond rotation;
  Vector3d translation;

  explicit Pose(const double* block) : rotation(block), translation(block[4], block[5], block[6]) {}
  Vector3d operator*(const Vector3d& p) const { return rotation * p + translation; }
  Matrix3d matrix() const { return rotation.toRotationMatrix(); }
};

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// d(q v)/d(x, y, z, w) for q v = v + 2 w u x v + 2 u x (u x v), u = (x, y, z).
Matrix34 rotation_derivative(const Eigen::Quaterniond& q, const Vector3d& v) {
  const Vector3d u = q.vec();
  Matrix34 D;
  D.leftCols<3>() = 2 * (-q.w() * cross_matrix(v) + u.dot(v) * Matrix3d::Identity() + u * v.transpose() -
                         2 * v * u.transpose());
  D.col(3) = 2 * u.cross(v);
  return D;
}

template <int Rows, int Columns, class M>
void write(const M& matrix, double* jacobian) {
  if (!jacobian) return;
  Eigen::Map<RowMajor<Rows, Columns>> J(jacobian);
  J = matrix;
}

/// Writes d(residual)/d(pose) for a residual that depends on pose * p.
template <int Rows>
void write_pose(const Eigen::Matrix<double, Rows, 3>& by_point, const Pose& pose, const Vector3d& p,
                double* jacobian) {
  if (!jacobian) return;
  Eigen::Map<RowMajor<Rows, 7>> J(jacobian);
  J.template leftCols<4>() = by_point * rotation_derivative(pose.rotation, p);
  J.template rightCols<3>() = by_point;
}

void write_residual(const Vector2d& seen, const Vector2d& pixel, double sigma_px, double* residuals) {
  residuals[0] = (seen.x() - pixel.x()) / sigma_px;
  residuals[1] = (seen.y() - pixel.y()) / sigma_px;
}

Vector2d pixel_of(const double* intrinsics, const Vector3d& p_cam) {
  return project<double>(intrinsics, intrinsics + 4, p_cam);
}

}  // namespace

ProjectionDerivatives project_with_derivatives(const double* intrinsics, const Vector3d& p_cam) {
  const double x = p_cam.x() / p_cam.z(), y = p_cam.y() / p_cam.z();
  const auto distorted = distortion_derivatives(intrinsics + 4, {x, y});
  Eigen::Matrix<double, 2, 3> normalised_by_point;
  normalised_by_point << 1, 0, -x, 0, 1, -y;
  normalised_by_point /= p_cam.z();

  const Eigen::Map<const Vector2d> f(intrinsics), centre(intrinsics + 2);
  ProjectionDerivatives result;
  result.pixel = f.cwiseProduct(distorted.value) + centre;
  result.by_point = f.asDiagonal() * distorted.by_point * normalised_by_point;
  result.by_intrinsics.leftCols<2>() = distorted.value.asDiagonal();
  result.by_intrinsics.middleCols<2>(2).setIdentity();
  result.by_intrinsics.rightCols<kDistortionTerms>() = f.asDiagonal() * distorted.by_terms;
  return result;
}

bool CornerResidual::Evaluate(const double* const* blocks, double* residuals, double** jacobians) const {
  const Pose cam_from_first(blocks[1]), first_from_board(blocks[2]);
  const Vector3d p_board = corner_.point(Eigen::Map<const Vector2d>(blocks[3]));
  const Vector3d p_first = first_from_board * p_board, p_cam = cam_from_first * p_first;
  if (!(p_cam.z() > 0)) return false;
  if (!jacobians) {
    write_residual(pixel_of(blocks[0], p_cam), pixel_, sigma_px_, residuals);
    return true;
  }
  const auto seen = project_with_derivatives(blocks[0], p_cam);
  write_residual(seen.pixel, pixel_, sigma_px_, residuals);
  write<2, kIntrinsics>(seen.by_intrinsics / sigma_px_, jacobians[0]);
  const Eigen::Matrix<double, 2, 3> by_point = seen.by_point / sigma_px_;
  write_pose<2>(by_point, cam_from_first, p_first, jacobians[1]);
  const Eigen::Matrix<double, 2, 3> by_first = by_point * cam_from_first.matrix();
  write_pose<2>(by_first, first_from_board, p_board, jacobians[2]);
  write<2, 2>(by_first * (first_from_board.rotation * Vector3d::UnitZ()) * corner_.weights.transpose(),
              jacobians[3]);
  return true;
}

namespace {

/// A point of the first frame at a travel, with its derivatives.
struct MovedPoint {
  Vector3d p;
  Matrix3d by_point, by_direction, by_axis_point;
};

MovedPoint translated(const Vector3d& p, const double* direction, double s) {
  return {p + s * Eigen::Map<const Vector3d>(direction), Matrix3d::Identity(), s * Matrix3d::Identity(),
          Matrix3d::Zero()};
}

MovedPoint turned(const Vector3d& p, const double* direction, const double* axis_point, double angle) {
  using Jet = ceres::Jet<double, 3>;
  const Eigen::Map<const Vector3d> c(axis_point);
  Jet angle_axis[3], from_axis[3], to[3];
  for (int i = 0; i < 3; ++i) {
    angle_axis[i] = Jet(angle * direction[i], i);
    from_axis[i] = Jet(p[i] - c[i]);
  }
  ceres::AngleAxisRotatePoint(angle_axis, from_axis, to);
  MovedPoint result;
  const Vector3d w = angle * Eigen::Map<const Vector3d>(direction);
  ceres::AngleAxisToRotationMatrix(w.data(), result.by_point.data());
  for (int i = 0; i < 3; ++i) {
    result.p[i] = to[i].a + c[i];
    result.by_direction.row(i) = angle * to[i].v.transpose();
  }
  result.by_axis_point = Matrix3d::Identity() - result.by_point;
  return result;
}

}  // namespace

bool TravelCornerResidual::Evaluate(const double* const* blocks, double* residuals,
                                    double** jacobians) const {
  const Pose cam_from_first(blocks[1]), first_from_board(blocks[2]);
  const Vector3d p_board = corner_.point(Eigen::Map<const Vector2d>(blocks[3]));
  const Vector3d p = first_from_board * p_board;
  const MovedPoint moved = motion_ == MotionType::kRotary ? turned(p, blocks[4], blocks[5], signed_travel_)
                                                          : translated(p, blocks[4], signed_travel_);
  const Vector3d p_cam = cam_from_first * moved.p;
  if (!(p_cam.z() > 0)) return false;
  const auto seen = project_with_derivatives(blocks[0], p_cam);
  write_residual(seen.pixel, pixel_, sigma_px_, residuals);
  if (!jacobians) return true;
  write<2, kIntrinsics>(seen.by_intrinsics / sigma_px_, jacobians[0]);
  const Eigen::Matrix<double, 2, 3> by_point = seen.by_point / sigma_px_;
  const Eigen::Matrix<double, 2, 3> by_moved = by_point * cam_from_first.matrix();
  write_pose<2>(by_point, cam_from_first, moved.p, jacobians[1]);
  write_pose<2>(by_moved * moved.by_point, first_from_board, p_board, jacobians[2]);
  write<2, 2>(by_moved * moved.by_point * (first_from_board.rotation * Vector3d::UnitZ()) *
                  corner_.weights.transpose(),
              jacobians[3]);
  write<2, 3>(by_moved * moved.by_direction, jacobians[4]);
  write<2, 3>(by_moved * moved.by_axis_point, jacobians[5]);
  return true;
}

bool StripeResidual::Evaluate(const double* const* blocks, double* residuals, double** jacobians) const {
  const Pose cam_from_first(blocks[1]), first_from_board(blocks[2]);
  const Eigen::Map<const Vector2d> warp(blocks[3]);
  const Eigen::Map<const Vector3d> n_laser(blocks[4]);
  const Vector3d p_local = place_.point(warp), n_local = place_.normal(warp);
  const Vector3d p_first = first_from_board * p_local, n_first = first_from_board.rotation * n_local;
  const Vector3d n_board = cam_from_first.rotation * n_first, origin = cam_from_first * p_first;
  // The point X of the three planes n_board.X = n_board.origin, n_laser.X = offset, across.X = 0, by Cramer's
  // rule: a and b are the first two columns of the inverse of the matrix of the normals.
  const Vector3d a = n_laser.cross(across_) / n_board.dot(n_laser.cross(across_));
  const Vector3d b = across_.cross(n_board) / n_board.dot(n_laser.cross(across_));
  const Vector3d p_cam = n_board.dot(origin) * a + blocks[4][3] * b;
  if (!(p_cam.z() > 0)) return false;
  if (!jacobians) {
    residuals[0] = normal_.dot(pixel_of(blocks[0], p_cam) - pixel_) / sigma_px_;
    return true;
  }
  const auto seen = project_with_derivatives(blocks[0], p_cam);
  residuals[0] = normal_.dot(seen.pixel - pixel_) / sigma_px_;
  write<1, kIntrinsics>(normal_.transpose() * seen.by_intrinsics / sigma_px_, jacobians[0]);
  const Eigen::RowVector3d by_point = normal_.transpose() * seen.by_point / sigma_px_;
  // dX = a (n_board.d(origin) + (origin - X).d(n_board)) + b (d(offset) - X.d(n_laser))
  const double by_a = by_point * a, by_b = by_point * b;
  const Eigen::RowVector3d by_origin = by_a * n_board.transpose();
  const Eigen::RowVector3d by_normal = by_a * (origin - p_cam).transpose();
  const Matrix3d R = cam_from_first.matrix();
  RowMajor<1, 7> by_camera, by_board;
  by_camera << by_normal * rotation_derivative(cam_from_first.rotation, n_first) +
                   by_origin * rotation_derivative(cam_from_first.rotation, p_first),
      by_origin;
  by_board << by_normal * R * rotation_derivative(first_from_board.rotation, n_local) +
                  by_origin * R * rotation_derivative(first_from_board.rotation, p_local),
      by_origin * R;
  write<1, 7>(by_camera, jacobians[1]);
  write<1, 7>(by_board, jacobians[2]);
  const Matrix3d R_board = R * first_from_board.matrix();
  Eigen::Matrix<double, 3, 2> normal_by_warp = Eigen::Matrix<double, 3, 2>::Zero();
  normal_by_warp.topRows<2>() = (-place_.slopes).asDiagonal();
  write<1, 2>(
      by_normal * R_board * normal_by_warp + (by_origin * R_board.col(2)) * place_.weights.transpose(),
      jacobians[3]);
  Eigen::RowVector4d by_plane;
  by_plane << -by_b * p_cam.transpose(), by_b;
  write<1, 4>(by_plane, jacobians[4]);
  return true;
}

bool LensPrior::Evaluate(const double* const* blocks, double* residuals, double** jacobians) const {
  constexpr double kSigma = 5;
  std::fill(residuals, residuals + kDistortionTerms, 0.0);
  Eigen::Matrix<double, kDistortionTerms, kIntrinsics> J;
  J.setZero();
  for (const int term : terms_) {
    residuals[term] = blocks[0][4 + term] / kSigma;
    J(term, 4 + term) = 1 / kSigma;
  }
  if (jacobians) write<kDistortionTerms, kIntrinsics>(J, jacobians[0]);
  return true;
}

}  // namespace lightstripe
