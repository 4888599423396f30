// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Planes n.X = d with |n| = 1 and d >= 0: laser planes in a camera frame, boards, tables.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace lightstripe {

struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;  ///< mm

  double signed_distance(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

/// The same plane with |n| = 1 and d >= 0. The normal must not be zero.
Plane canonical(const Plane& plane);

/// The plane as seen from frame a, given it in frame b: a_from_b as rotation matrix and translation.
Plane transformed(const Plane& plane_b, const Eigen::Matrix3d& rotation_a_from_b,
                  const Eigen::Vector3d& translation_a_from_b);

/// Where the ray origin + s * direction, s > 0, meets the plane; nothing if it is parallel or the plane lies
/// behind.
std::optional<Eigen::Vector3d> intersect(const Plane& plane, const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction);

struct PlaneFit {
  Plane plane;
  double rms = 0;           ///< mm, distances of the points to the plane
  Eigen::Vector3d spread;   ///< rms extent along the three principal axes, descending, mm
  bool determined() const;  ///< false where the points lie on one line or at one place
};

/// Least-squares plane through at least three points.
PlaneFit fit_plane(std::span<const Eigen::Vector3d> points);

}  // namespace lightstripe
