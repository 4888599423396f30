// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Cameras and poses as Ceres takes them.
#pragma once

#include <ceres/manifold.h>
#include <ceres/product_manifold.h>

#include <array>

#include "calib/adjust/lens_model.h"
#include "calib/adjust/residuals.h"
#include "core/camera.h"
#include "core/transform.h"

namespace lightstripe {

using PoseManifold = ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<3>>;
using PoseBlock = std::array<double, 7>;  ///< quaternion x y z w, translation
PoseBlock pose_block_of(const Rigid3& pose);
Rigid3 pose_of(const double* block);

using IntrinsicsBlock = std::array<double, kIntrinsics>;  ///< fx fy cx cy, distortion
IntrinsicsBlock intrinsics_block_of(const Camera& camera);
/// `like`: its image's size.
Camera camera_of(const Camera& like, const double* block);
/// The distortion terms that the model does not have stay as they are.
ceres::Manifold* intrinsics_manifold(LensModel lens);

}  // namespace lightstripe
