// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/artefact_fit.h"

#include <Eigen/Geometry>
#include <array>

#include "core/linear_algebra.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d mean_of(const Points3& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Two unit vectors square to the axis, or x, y, z of a ball's centre.
std::array<Vector3d, 2> square_to(const Vector3d& axis) {
  const Vector3d first = axis.unitOrthogonal();
  return {first, axis.cross(first)};
}

/// One row of the Jacobian of the distance: place (3, of which a cylinder uses 2), direction (2), radius.
using Row = Eigen::Matrix<double, 6, 1>;

Row derivative(const RoundBody& body, const Vector3d& p, bool free_axis) {
  const double along = body.axis.dot(p - body.center);
  const Vector3d out = body.way_out(p).normalized();
  Row row = Row::Zero();
  row(5) = -1;
  if (body.axis.isZero()) {
    row.head<3>() = -out;
    return row;
  }
  const auto [e1, e2] = square_to(body.axis);
  row(0) = -out.dot(e1), row(1) = -out.dot(e2);
  if (free_axis) row(3) = -along * out.dot(e1), row(4) = -along * out.dot(e2);
  return row;
}

void move(RoundBody& body, const Row& step) {
  body.radius += step(5);
  if (body.axis.isZero()) {
    body.center += step.head<3>();
    return;
  }
  const auto [e1, e2] = square_to(body.axis);
  body.center += step(0) * e1 + step(1) * e2;
  body.axis = (body.axis + step(3) * e1 + step(4) * e2).normalized();
}

}  // namespace

ParallelFaces fit_parallel_faces(const Points3& first, const Points3& second, bool whole) {
  const std::array<const Points3*, 2> faces{&first, &second};
  Matrix3d scatter = Matrix3d::Zero();
  std::array<Vector3d, 2> means;
  for (std::size_t f = 0; f < 2; ++f) {
    means[f] = mean_of(*faces[f]);
    for (const Vector3d& p : *faces[f]) scatter += (p - means[f]) * (p - means[f]).transpose();
  }
  ParallelFaces out;
  if (whole) {
    out.normal = symmetric_eigen(scatter).vectors.col(0);
  } else {
    out.normal << 0, symmetric_eigen(scatter.bottomRightCorner<2, 2>()).vectors.col(0);
  }
  for (int f = 0; f < 2; ++f) out.offset[f] = out.normal.dot(means[static_cast<std::size_t>(f)]);
  return out;
}

RoundBody fit_round_body(const Points3& points, RoundBody body, bool free_axis) {
  constexpr int kSteps = 20;
  for (int step = 0; step < kSteps; ++step) {
    if (!body.axis.isZero())  // in the middle of the points, where place and direction part
      body.center += body.axis * body.axis.dot(mean_of(points) - body.center);
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Row right = Row::Zero();
    for (const Vector3d& p : points) {
      const Row row = derivative(body, p, free_axis);
      normal += row * row.transpose();
      right -= row * body.distance(p);
    }
    for (int i = 0; i < 6; ++i)
      if (normal(i, i) <= 0) normal(i, i) = 1;  // not an unknown of this body
    const Row change = solve_symmetric(normal, right);
    if (!change.allFinite()) break;
    move(body, change);
    if (change.norm() < 1e-10 * (1 + body.radius)) break;
  }
  return body;
}

}  // namespace lightstripe
