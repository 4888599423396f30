// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/board_pose.h"

#include <cmath>

#include "calib/board/board_homography.h"
#include "calib/board/seen_corners.h"
#include "calib/start/refine_views.h"

namespace lightstripe {

std::optional<Rigid3> board_pose(const Camera& camera, const Target& target,
                                 const std::vector<Eigen::Vector2d>& corners) {
  std::vector<Eigen::Vector2d> rays, board;
  const SeenCorners seen = seen_corners(corners, target);
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    const auto ray = unproject(camera, seen.pixels[i]);
    if (!ray) continue;
    rays.emplace_back(ray->x(), ray->y());
    board.push_back(seen.board[i]);
  }
  const auto H = find_homography(board, rays);
  if (!H) return std::nullopt;
  Rigid3 pose = pose_from_homography(*H, board.front());
  refine_pose(camera, target, corners, pose);
  return pose;
}

double corner_rms_px(const Camera& camera, const Target& target, const Rigid3& cam_from_board,
                     const std::vector<Eigen::Vector2d>& corners) {
  double sum = 0;
  int count = 0;
  const SeenCorners seen = seen_corners(corners, target);
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    const Eigen::Vector2d& p = seen.board[i];
    const auto q = project(camera, cam_from_board * Eigen::Vector3d(p.x(), p.y(), 0));
    if (!q) continue;
    sum += (*q - seen.pixels[i]).squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace lightstripe
