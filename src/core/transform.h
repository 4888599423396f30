// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Rigid transforms, named a_from_b: p_a = a_from_b * p_b, and a_from_c = a_from_b * b_from_c.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace lightstripe {

/// Radians of one degree.
inline constexpr double kDegree = std::numbers::pi / 180;

struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return rotation * p + translation; }
  Rigid3 operator*(const Rigid3& b) const {
    return {(rotation * b.rotation).normalized(), rotation * b.translation + translation};
  }
  Rigid3 inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {back, -(back * translation)};
  }
};

/// Angle of a rotation, radians in [0, pi].
inline double rotation_angle(const Eigen::Quaterniond& q) {
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

}  // namespace lightstripe
