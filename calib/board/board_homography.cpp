// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/board_homography.h"

#include <Eigen/LU>
#include <cmath>

#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Moves the points' mean to 0 and their mean distance from it to sqrt(2).
Matrix3d normalisation(std::span<const Vector2d> points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p / static_cast<double>(points.size());
  double distance = 0;
  for (const Vector2d& p : points) distance += (p - mean).norm() / static_cast<double>(points.size());
  const double scale = distance > 0 ? std::sqrt(2.0) / distance : 1;
  Matrix3d out = Matrix3d::Identity();
  out << scale, 0, -scale * mean.x(), 0, scale, -scale * mean.y(), 0, 0, 1;
  return out;
}

}  // namespace

std::optional<Matrix3d> find_homography(std::span<const Vector2d> from, std::span<const Vector2d> to) {
  using Row = Eigen::Matrix<double, 1, 9>;
  if (from.size() < 4 || from.size() != to.size()) return std::nullopt;
  const Matrix3d scale_from = normalisation(from), scale_to = normalisation(to);
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vector3d p = scale_from * from[i].homogeneous(), q = scale_to * to[i].homogeneous();
    Row x = Row::Zero(), y = Row::Zero();
    x << p.transpose(), 0, 0, 0, -q.x() * p.transpose();
    y << 0, 0, 0, p.transpose(), -q.y() * p.transpose();
    normal += x.transpose() * x + y.transpose() * y;
  }
  const SymmetricEigen eigen = symmetric_eigen(normal);
  constexpr double kOneLine = 1e-12;  // of the largest eigenvalue: a second solution fits as well
  if (!(eigen.values[1] > kOneLine * eigen.values[8])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = eigen.vectors.col(0);
  Matrix3d H;
  H << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
  H = scale_to.inverse() * H * scale_from;
  if (!H.allFinite() || H.norm() == 0) return std::nullopt;
  return H / H.norm();
}

Rigid3 pose_from_homography(const Matrix3d& rays_from_board, const Eigen::Vector2d& seen) {
  const double scale = 2 / (rays_from_board.col(0).norm() + rays_from_board.col(1).norm());
  Matrix3d H = scale * rays_from_board;
  if (H.row(2).dot(seen.homogeneous()) < 0) H = -H;
  Matrix3d axes;
  axes << H.col(0), H.col(1), H.col(0).cross(H.col(1));
  Rigid3 pose;
  pose.rotation = Eigen::Quaterniond(nearest_rotation(axes)).normalized();
  pose.translation = H.col(2);
  return pose;
}

}  // namespace lightstripe
