// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Least-squares shapes of an artefact: parallel faces, circle or ball, cylinder.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace lightstripe {

using Points3 = std::vector<Eigen::Vector3d>;

/// Two parallel faces n.p = d[0] and n.p = d[1].
struct ParallelFaces {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset[2] = {0, 0};

  double distance(const Eigen::Vector3d& p, int face) const { return normal.dot(p) - offset[face]; }
};
/// Total least squares with a common normal. Without `whole` the x of the points is not looked at.
ParallelFaces fit_parallel_faces(const Points3& first, const Points3& second, bool whole);

/// A round body about an axis (a cylinder) or about a point (a ball; axis zero).
struct RoundBody {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit, or zero
  double radius = 0;

  /// From the axis, or the centre of a ball, straight to the point.
  Eigen::Vector3d way_out(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d from = p - center;
    return from - axis * axis.dot(from);
  }
  double distance(const Eigen::Vector3d& p) const { return way_out(p).norm() - radius; }
};
/// Gauss-Newton on the sum of squared distances (geometric fit: Ahn, Rauh, Warnecke 2001) from a start value;
/// the direction of an axis stays as it is unless `free_axis`.
RoundBody fit_round_body(const Points3& points, RoundBody start, bool free_axis);

}  // namespace lightstripe
