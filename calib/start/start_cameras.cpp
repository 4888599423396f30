// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/adjust/board_surface.h"
#include "calib/board/board_homography.h"
#include "calib/board/seen_corners.h"
#include "calib/start/board_pose.h"
#include "calib/start/initial_values.h"
#include "calib/start/refine_views.h"
#include "core/counted.h"
#include "core/linear_algebra.h"
#include "core/transform.h"

namespace lightstripe {
namespace {

constexpr double kMinTiltDeg =
    3;  // of the boards against their mean direction; below it f and the range are one
constexpr double kMaxViewErrorPx = 3;  // a view beyond it has corners in a wrong order, or another board

std::optional<Eigen::Matrix3d> pixel_from_board(const SessionView& view, const Target& target) {
  const SeenCorners corners = seen_corners(view.corners, target);
  return find_homography(corners.board, corners.pixels);
}

/// The board's normal for a camera of a guessed focal length: K^T times the vanishing line of the board's
/// plane.
Eigen::Vector3d rough_normal(const SessionView& view, const Target& target, double width, double height) {
  const auto H = pixel_from_board(view, target);
  if (!H) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d vanishing_line = H->inverse().transpose().col(2);
  const double f = 1.5 * std::max(width, height);
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K << f, 0, width / 2, 0, f, height / 2, 0, 0, 1;
  const Eigen::Vector3d normal = (K.transpose() * vanishing_line).normalized();
  return normal.z() < 0 ? Eigen::Vector3d(-normal) : normal;
}

/// Rms distance of the corners that both views show, px; large where they share none.
double corner_distance_px(const SessionView& a, const SessionView& b) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    if (!is_seen(a.corners[i]) || !is_seen(b.corners[i])) continue;
    sum += (a.corners[i] - b.corners[i]).squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 1e9;
}

void refuse_single_pose(const std::vector<const SessionView*>& views, const std::string& sensor,
                        const std::array<int, 2>& size) {
  const double moved_px = 0.003 * std::hypot(size[0], size[1]);
  for (const auto* view : views)
    if (corner_distance_px(*view, *views.front()) > moved_px) return;
  throw NotUsable(
      fmt::format("sensor {}: the board has the same pose in all views; move it over the measuring range and "
                  "tilt it by 20 "
                  "to 45 degrees to different sides",
                  sensor));
}

void refuse_parallel_boards(const std::vector<const SessionView*>& views, const Target& target,
                            const std::string& sensor, const std::array<int, 2>& size) {
  std::vector<Eigen::Vector3d> normals;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto* view : views) {
    normals.push_back(rough_normal(*view, target, size[0], size[1]));
    mean += normals.back();
  }
  double tilt = 0;
  for (const auto& normal : normals)
    tilt = std::max(tilt, std::acos(std::min(1.0, normal.dot(mean.normalized()))));
  if (tilt < kMinTiltDeg * kDegree)
    throw NotUsable(
        fmt::format("sensor {}: all boards are parallel within {:.1f} degrees, so focal length and range "
                    "cannot be told apart; tilt the board by 20 to 45 degrees to different sides",
                    sensor, tilt / kDegree));
}

struct CameraStart {
  Camera camera;
  std::vector<Rigid3> cam_from_board;
  std::vector<double> view_rms_px;
};

/// Focal lengths from the homographies of all views, the principal point in the image's middle: the images of
/// a board's axes, and of their bisectors, are orthogonal (Zhang 2000, section 3.1, with a known centre).
Camera focal_start(const std::vector<Eigen::Matrix3d>& homographies, const std::array<int, 2>& size) {
  Camera camera{size[0], size[1], 0, 0, 0.5 * (size[0] - 1), 0.5 * (size[1] - 1), {}};
  Eigen::Matrix3d to_centre = Eigen::Matrix3d::Identity();
  to_centre.col(2) << -camera.cx, -camera.cy, 1;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const Eigen::Matrix3d& H : homographies) {
    const Eigen::Matrix3d centred = to_centre * H;
    const Eigen::Vector3d h = centred.col(0), v = centred.col(1);
    const std::array<std::pair<Eigen::Vector3d, Eigen::Vector3d>, 2> pairs{
        {{h.normalized(), v.normalized()}, {(h + v).normalized(), (h - v).normalized()}}};
    for (const auto& [first, second] : pairs) {  // first' diag(1/fx^2, 1/fy^2, 1) second = 0
      const Eigen::Vector2d row(first.x() * second.x(), first.y() * second.y());
      A += row * row.transpose();
      b -= row * (first.z() * second.z());
    }
  }
  const Eigen::Vector2d inverse_squares = solve_least_squares(A, b);
  camera.fx = std::sqrt(std::abs(1 / inverse_squares.x()));
  camera.fy = std::sqrt(std::abs(1 / inverse_squares.y()));
  return camera;
}

/// Nothing where the views have no camera in common.
std::optional<CameraStart> solve_camera(const std::vector<const SessionView*>& views, const Target& target,
                                        const std::array<int, 2>& size) {
  constexpr double kMaxFocal = 1e6;
  const auto plausible = [](double f) { return f > 0 && f < kMaxFocal; };
  std::vector<Eigen::Matrix3d> homographies;
  std::vector<const std::vector<Eigen::Vector2d>*> corners;
  for (const auto* view : views) {
    const auto H = pixel_from_board(*view, target);
    if (!H) return std::nullopt;
    homographies.push_back(*H);
    corners.push_back(&view->corners);
  }
  CameraStart start;
  start.camera = focal_start(homographies, size);
  if (!plausible(start.camera.fx) || !plausible(start.camera.fy)) return std::nullopt;
  for (std::size_t i = 0; i < views.size(); ++i) {
    Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
    K << start.camera.fx, 0, start.camera.cx, 0, start.camera.fy, start.camera.cy, 0, 0, 1;
    const Eigen::Vector2d seen = seen_corners(*corners[i], target).board.front();
    start.cam_from_board.push_back(pose_from_homography(K.inverse() * homographies[i], seen));
    refine_pose(start.camera, target, *corners[i], start.cam_from_board.back());
  }
  if (!refine_camera(start.camera, target, corners, start.cam_from_board) || !plausible(start.camera.fx) ||
      !plausible(start.camera.fy))
    return std::nullopt;
  for (std::size_t i = 0; i < views.size(); ++i)
    start.view_rms_px.push_back(corner_rms_px(start.camera, target, start.cam_from_board[i], *corners[i]));
  return start;
}

CameraStart calibrate_camera(const std::vector<const SessionView*>& views, const Target& target,
                             const std::string& sensor, const std::array<int, 2>& size) {
  if (auto start = solve_camera(views, target, size)) return *std::move(start);
  throw NotUsable(
      fmt::format("sensor {}: no camera explains the {}; tilt the board by 20 to 45 degrees to "
                  "different sides and check the number of corners and the pitch",
                  sensor, counted(views.size(), "board view")));
}

/// One view of wrong corners spoils the whole start: the worst is left out while it stands out.
CameraStart calibrate_camera_robustly(InitialValues& values, std::vector<std::size_t>& indices,
                                      const std::string& sensor, const std::array<int, 2>& size) {
  const std::size_t least = std::max<std::size_t>(3, indices.size() - indices.size() / 4);
  for (;;) {
    std::vector<const SessionView*> views;
    views.reserve(indices.size());
    for (const auto i : indices) views.push_back(&values.session.views[i]);
    CameraStart start = calibrate_camera(views, values.session.target, sensor, size);
    const auto worst = std::max_element(start.view_rms_px.begin(), start.view_rms_px.end());
    if (!(*worst > kMaxViewErrorPx) || indices.size() <= least) return start;
    const auto position = worst - start.view_rms_px.begin();
    values.warnings.push_back(fmt::format("{}: left out, its corners fit no pose of the board ({:.1f} px)",
                                          views[static_cast<std::size_t>(position)]->image, *worst));
    indices.erase(indices.begin() + position);
  }
}

Rigid3 pose_of(const SessionView& view, const Target& target, const Camera& camera) {
  const auto pose = board_pose(camera, target, view.corners);
  if (!pose)
    throw NotUsable(view.image +
                    ": no ray of the given camera meets the board; check the camera that is given");
  return *pose;
}

bool knows_heights(const SessionViews& session, std::size_t sensor) {
  return std::any_of(session.views.begin(), session.views.end(), [&](const SessionView& view) {
    return view.sensor == static_cast<int>(sensor) && view.height_mm;
  });
}

/// Pictures of known heights stand on the bed's board.
void place_heights(InitialValues& values, std::vector<bool>& keep) {
  const auto& views = values.session.views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].height_mm) continue;
    for (std::size_t k = 0; k < views.size(); ++k) {
      if (views[k].pose != views[i].pose || views[k].height_mm || !keep[k]) continue;
      values.cam_from_board[i] = raised(values.cam_from_board[k], *views[i].height_mm);
      keep[i] = true;
    }
  }
}

}  // namespace

void start_cameras(InitialValues& values) {
  auto& m = values.session;
  std::vector<bool> keep(m.views.size(), false);
  values.cam_from_board.resize(m.views.size());
  for (std::size_t sensor = 0; sensor < m.sensor_names.size(); ++sensor) {
    std::vector<std::size_t> indices;
    std::vector<const SessionView*> views;
    for (std::size_t i = 0; i < m.views.size(); ++i) {
      if (m.views[i].sensor != static_cast<int>(sensor) || m.views[i].pose < 0 || m.views[i].height_mm)
        continue;
      indices.push_back(i);
      views.push_back(&m.views[i]);
    }
    if (!knows_heights(m, sensor)) refuse_single_pose(views, m.sensor_names[sensor], m.image_sizes[sensor]);
    if (m.given_cameras[sensor]) {
      values.state.sensors.push_back({m.given_cameras[sensor]->camera, {}, {}});
      for (const std::size_t i : indices) {
        keep[i] = true;
        values.cam_from_board[i] = pose_of(m.views[i], m.target, m.given_cameras[sensor]->camera);
      }
      continue;
    }
    refuse_parallel_boards(views, m.target, m.sensor_names[sensor], m.image_sizes[sensor]);
    const auto start =
        calibrate_camera_robustly(values, indices, m.sensor_names[sensor], m.image_sizes[sensor]);
    values.state.sensors.push_back({start.camera, {}, {}});
    for (std::size_t i = 0; i < indices.size(); ++i) {
      keep[indices[i]] = true;
      values.cam_from_board[indices[i]] = start.cam_from_board[i];
    }
  }
  for (std::size_t i = 0; i < m.views.size(); ++i) {
    if (m.views[i].pose >= 0) continue;
    keep[i] = true;
    const auto& camera = values.state.sensors[static_cast<std::size_t>(m.views[i].sensor)].camera;
    values.cam_from_board[i] = pose_of(m.views[i], m.target, camera);
  }
  place_heights(values, keep);
  keep_views(values, keep);
}

}  // namespace lightstripe
