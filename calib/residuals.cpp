// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/residuals.h"

#include <ceres/jet.h>
#include <ceres/rotation.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

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
  using Jet = ceres::Jet<double, kDistortionTerms + 2>;
  Jet distortion[kDistortionTerms];
  for (int i = 0; i < kDistortionTerms; ++i) distortion[i] = Jet(intrinsics[4 + i], i);
  const double x = p_cam.x() / p_cam.z(), y = p_cam.y() / p_cam.z();
  const Eigen::Matrix<Jet, 2, 1> d =
      distort<Jet>(distortion, {Jet(x, kDistortionTerms), Jet(y, kDistortionTerms + 1)});
  Eigen::Matrix<double, 2, 3> normalised_by_point;
  normalised_by_point << 1, 0, -x, 0, 1, -y;
  normalised_by_point /= p_cam.z();

  ProjectionDerivatives result;
  result.by_intrinsics.setZero();
  for (int i = 0; i < 2; ++i) {
    const double f = intrinsics[i];
    result.pixel[i] = f * d[i].a + intrinsics[2 + i];
    result.by_intrinsics(i, i) = d[i].a;
    result.by_intrinsics(i, 2 + i) = 1;
    result.by_intrinsics.row(i).tail<kDistortionTerms>() = f * d[i].v.head<kDistortionTerms>().transpose();
    result.by_point.row(i) = f * d[i].v.tail<2>().transpose() * normalised_by_point;
  }
  return result;
}

bool CornerResidual::Evaluate(const double* const* blocks, double* residuals, double** jacobians) const {
  const Pose cam_from_first(blocks[1]), first_from_board(blocks[2]);
  const Vector3d p_first = first_from_board * p_board_, p_cam = cam_from_first * p_first;
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
  write_pose<2>(by_point * cam_from_first.matrix(), first_from_board, p_board_, jacobians[2]);
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
  const Vector3d p = first_from_board * p_board_;
  const MovedPoint moved = motion_ == MotionType::kRotary ? turned(p, blocks[3], blocks[4], signed_travel_)
                                                          : translated(p, blocks[3], signed_travel_);
  const Vector3d p_cam = cam_from_first * moved.p;
  if (!(p_cam.z() > 0)) return false;
  const auto seen = project_with_derivatives(blocks[0], p_cam);
  write_residual(seen.pixel, pixel_, sigma_px_, residuals);
  if (!jacobians) return true;
  write<2, kIntrinsics>(seen.by_intrinsics / sigma_px_, jacobians[0]);
  const Eigen::Matrix<double, 2, 3> by_point = seen.by_point / sigma_px_;
  const Eigen::Matrix<double, 2, 3> by_moved = by_point * cam_from_first.matrix();
  write_pose<2>(by_point, cam_from_first, moved.p, jacobians[1]);
  write_pose<2>(by_moved * moved.by_point, first_from_board, p_board_, jacobians[2]);
  write<2, 3>(by_moved * moved.by_direction, jacobians[3]);
  write<2, 3>(by_moved * moved.by_axis_point, jacobians[4]);
  return true;
}

bool StripeResidual::Evaluate(const double* const* blocks, double* residuals, double** jacobians) const {
  const Pose cam_from_first(blocks[1]), first_from_board(blocks[2]);
  const Eigen::Map<const Vector3d> n_laser(blocks[3]);
  const Vector3d z_first = first_from_board.rotation * Vector3d::UnitZ();
  const Vector3d n_board = cam_from_first.rotation * z_first;
  const Vector3d origin = cam_from_first * first_from_board.translation;
  // The point X of the three planes n_board.X = n_board.origin, n_laser.X = offset, across.X = 0, by Cramer's
  // rule: a and b are the first two columns of the inverse of the matrix of the normals.
  const Vector3d a = n_laser.cross(across_) / n_board.dot(n_laser.cross(across_));
  const Vector3d b = across_.cross(n_board) / n_board.dot(n_laser.cross(across_));
  const Vector3d p_cam = n_board.dot(origin) * a + blocks[3][3] * b;
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
  const Eigen::RowVector3d by_n_board = by_a * (origin - p_cam).transpose();
  const Matrix3d R = cam_from_first.matrix();
  RowMajor<1, 7> by_camera, by_board;
  by_camera << by_n_board * rotation_derivative(cam_from_first.rotation, z_first) +
                   by_origin * rotation_derivative(cam_from_first.rotation, first_from_board.translation),
      by_origin;
  by_board << by_n_board * R * rotation_derivative(first_from_board.rotation, Vector3d::UnitZ()),
      by_origin * R;
  write<1, 7>(by_camera, jacobians[1]);
  write<1, 7>(by_board, jacobians[2]);
  Eigen::RowVector4d by_plane;
  by_plane << -by_b * p_cam.transpose(), by_b;
  write<1, 4>(by_plane, jacobians[3]);
  return true;
}

}  // namespace lightstripe
