// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A board's pose for tests.
#pragma once

#include <Eigen/Geometry>

#include "core/transform.h"

namespace lightstripe::testing {

/// Turned about `axis`, moved to `place` (mm).
inline Rigid3 tilted_pose(double degrees, const Eigen::Vector3d& axis, const Eigen::Vector3d& place) {
  Rigid3 pose;
  pose.rotation = Eigen::AngleAxisd(degrees * 3.14159265358979 / 180, axis.normalized());
  pose.translation = place;
  return pose;
}

}  // namespace lightstripe::testing
