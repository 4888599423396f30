// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A rigid move in the plane of a section.
#pragma once

#include <Eigen/Geometry>

namespace lightstripe {

/// p -> R(angle) p + translation.
struct SectionMove {
  double angle_rad = 0;                                   ///< counterclockwise, from u to v
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();  ///< mm

  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    return Eigen::Rotation2Dd(angle_rad) * p + translation;
  }
};

}  // namespace lightstripe
