// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/adjust/board_surface.h"

#include "calib/adjust/rig_state.h"

namespace lightstripe {

using Eigen::Vector2d;

BoardPlace board_place(const Target& target, const Vector2d& xy) {
  const Vector2d half = target.middle();
  const Vector2d at = (xy - half).cwiseQuotient(half);
  return {xy, Vector2d::Ones() - at.cwiseAbs2(), -2 * at.cwiseQuotient(half), 0};
}

std::optional<BoardPlace> seen_place(const Target& target, const Camera& camera, const Rigid3& cam_from_board,
                                     const Vector2d& pixel) {
  const auto ray = unproject(camera, pixel);
  const auto p_cam =
      ray ? intersect(board_plane(cam_from_board), Eigen::Vector3d::Zero(), *ray) : std::nullopt;
  if (!p_cam) return std::nullopt;
  return board_place(target, (cam_from_board.inverse() * *p_cam).head<2>());
}

Rigid3 raised(const Rigid3& cam_from_board, double height_mm) {
  return cam_from_board * Rigid3{Eigen::Quaterniond::Identity(), {0, 0, -height_mm}};
}

std::optional<BoardPlace> seen_place_on_top(const Camera& camera, const Rigid3& cam_from_board,
                                            double height_mm, const Vector2d& pixel) {
  const Rigid3 cam_from_top = raised(cam_from_board, height_mm);
  const auto ray = unproject(camera, pixel);
  const auto p_cam = ray ? intersect(board_plane(cam_from_top), Eigen::Vector3d::Zero(), *ray) : std::nullopt;
  if (!p_cam) return std::nullopt;
  return BoardPlace{(cam_from_top.inverse() * *p_cam).head<2>(), Vector2d::Zero(), Vector2d::Zero(),
                    -height_mm};
}

Plane tangent_plane(const BoardPlace& place, const Vector2d& warp, const Rigid3& cam_from_board) {
  const Eigen::Vector3d normal = cam_from_board.rotation * place.normal(warp);
  return canonical({normal, normal.dot(cam_from_board * place.point(warp))});
}

}  // namespace lightstripe
