// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/start/board_pose.h"

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "calib/observations.h"

namespace lightstripe {

std::optional<Rigid3> board_pose(const Camera& camera, const Target& target,
                                 const std::vector<Eigen::Vector2d>& corners) {
  std::vector<cv::Point2d> rays;
  std::vector<cv::Point3d> board;
  for (int i = 0; i < target.num_corners(); ++i) {
    const auto& corner = corners[static_cast<std::size_t>(i)];
    const auto ray = is_seen(corner) ? unproject(camera, corner) : std::nullopt;
    if (!ray) continue;
    rays.emplace_back(ray->x(), ray->y());
    board.emplace_back(target.corner(i).x(), target.corner(i).y(), 0);
  }
  if (rays.size() < 4) return std::nullopt;
  cv::Mat r, t;
  cv::solvePnP(board, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), r, t);
  const Eigen::Vector3d turn(r.at<double>(0), r.at<double>(1), r.at<double>(2));
  Rigid3 pose;
  if (turn.norm() > 0) pose.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized());
  pose.translation = {t.at<double>(0), t.at<double>(1), t.at<double>(2)};
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
