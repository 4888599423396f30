// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/board_pose.h"

#include <cmath>

#include "calib/board/board_homography.h"
#include "calib/observations.h"
#include "calib/start/refine_views.h"

namespace lightstripe {

std::optional<Rigid3> board_pose(const Camera& camera, const Target& target,
                                 const std::vector<Eigen::Vector2d>& corners) {
  std::vector<Eigen::Vector2d> rays, board;
  for (int i = 0; i < target.num_corners(); ++i) {
    const auto& corner = corners[static_cast<std::size_t>(i)];
    const auto ray = is_seen(corner) ? unproject(camera, corner) : std::nullopt;
    if (!ray) continue;
    rays.emplace_back(ray->x(), ray->y());
    board.push_back(target.corner(i));
  }
  const auto H = find_homography(board, rays);
  if (!H) return std::nullopt;
  Rigid3 pose = pose_from_homography(*H);
  refine_pose(camera, target, corners, pose);
  return pose;
}

double corner_rms_px(const Camera& camera, const Target& target, const Rigid3& cam_from_board,
                     const std::vector<Eigen::Vector2d>& corners) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < target.num_corners(); ++i) {
    const auto& corner = corners[static_cast<std::size_t>(i)];
    if (!is_seen(corner)) continue;
    const Eigen::Vector2d p = target.corner(i);
    const auto q = project(camera, cam_from_board * Eigen::Vector3d(p.x(), p.y(), 0));
    if (!q) continue;
    sum += (*q - corner).squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace lightstripe
