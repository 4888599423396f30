// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/rig.h"

#include "core/error.h"

namespace lightstripe {

Eigen::Quaterniond rig_rotation(const Eigen::Vector3d& x_cam, const Eigen::Vector3d& up_cam) {
  const Eigen::Vector3d x = x_cam.normalized();
  Eigen::Vector3d z = up_cam - up_cam.dot(x) * x;
  LIGHTSTRIPE_CHECK(z.norm() > 1e-6 * up_cam.norm(), "up must not be parallel to the direction of travel");
  z.normalize();
  Eigen::Matrix3d rig_from_camera;
  rig_from_camera.row(0) = x;
  rig_from_camera.row(1) = z.cross(x);
  rig_from_camera.row(2) = z;
  return Eigen::Quaterniond(rig_from_camera).normalized();
}

}  // namespace lightstripe
