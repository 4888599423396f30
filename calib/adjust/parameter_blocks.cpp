// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/parameter_blocks.h"

#include <algorithm>
#include <vector>

namespace lightstripe {

IntrinsicsBlock intrinsics_block_of(const Camera& camera) {
  IntrinsicsBlock block{camera.fx, camera.fy, camera.cx, camera.cy};
  std::copy(camera.distortion.begin(), camera.distortion.end(), block.begin() + 4);
  return block;
}

Camera camera_of(const Camera& like, const double* block) {
  Camera camera{like.width, like.height, block[0], block[1], block[2], block[3], {}};
  std::copy(block + 4, block + kIntrinsics, camera.distortion.begin());
  return camera;
}

PoseBlock pose_block_of(const Rigid3& pose) {
  const auto& q = pose.rotation;
  const auto& t = pose.translation;
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

Rigid3 pose_of(const double* block) {
  return {Eigen::Quaterniond(block[3], block[0], block[1], block[2]).normalized(),
          {block[4], block[5], block[6]}};
}

ceres::Manifold* intrinsics_manifold(LensModel lens) {
  const auto free = free_terms(lens);
  std::vector<int> fixed;
  for (int i = 0; i < kDistortionTerms; ++i)
    if (std::find(free.begin(), free.end(), i) == free.end()) fixed.push_back(4 + i);
  return new ceres::SubsetManifold(kIntrinsics, fixed);
}

}  // namespace lightstripe
