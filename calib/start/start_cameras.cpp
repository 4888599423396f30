// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <span>

#include "calib/adjust/board_surface.h"
#include "calib/start/board_pose.h"
#include "calib/start/initial_values.h"

namespace lightstripe {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMinTiltDeg =
    3;  // of the boards against their mean direction; below it f and the range are one
constexpr double kMaxViewErrorPx = 3;  // a view beyond it has corners in a wrong order, or another board

std::vector<cv::Point2f> cv_points(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<cv::Point2f> points;
  points.reserve(corners.size());
  for (const auto& p : corners)
    if (is_seen(p)) points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  return points;
}

/// The seen corners on the board.
std::vector<cv::Point3f> cv_board(const Target& target, const std::vector<Eigen::Vector2d>& corners) {
  std::vector<cv::Point3f> points;
  for (int i = 0; i < target.num_corners(); ++i) {
    if (!is_seen(corners[static_cast<std::size_t>(i)])) continue;
    const Eigen::Vector2d p = target.corner(i);
    points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0f);
  }
  return points;
}

/// The value to 20 bits: enough for a start. OpenCV solves by LAPACK, whose last bits depend on where in
/// memory its matrices happen to lie, that is on the run; what follows must not.
double rounded(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, 20)), exponent - 20);
}

double rounded(const cv::Mat& values, int i) { return rounded(values.at<double>(i)); }

Rigid3 rounded(const Rigid3& pose) {
  const Eigen::Vector4d q = pose.rotation.coeffs().unaryExpr([](double v) { return rounded(v); });
  return {Eigen::Quaterniond(q).normalized(),
          pose.translation.unaryExpr([](double v) { return rounded(v); })};
}

Rigid3 rigid(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const Eigen::Vector3d r(rounded(rotation_vector, 0), rounded(rotation_vector, 1),
                          rounded(rotation_vector, 2));
  const double angle = r.norm();
  Rigid3 result;
  if (angle > 0) result.rotation = Eigen::AngleAxisd(angle, r / angle);
  result.translation = {rounded(translation, 0), rounded(translation, 1), rounded(translation, 2)};
  return result;
}

/// The board's normal for a camera of a guessed focal length: K^T times the vanishing line of the board's
/// plane.
Eigen::Vector3d rough_normal(const SessionView& view, const Target& target, double width, double height) {
  std::vector<cv::Point2f> board;
  for (const auto& p : cv_board(target, view.corners)) board.emplace_back(p.x, p.y);
  const cv::Mat H = cv::findHomography(board, cv_points(view.corners));
  if (H.empty()) return Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d pixel_from_board;
  for (int i = 0; i < 9; ++i) pixel_from_board(i / 3, i % 3) = H.at<double>(i / 3, i % 3);
  const Eigen::Vector3d vanishing_line = pixel_from_board.inverse().transpose().col(2);
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

CameraStart calibrate_camera(const std::vector<const SessionView*>& views, const Target& target,
                             const std::string& sensor, const std::array<int, 2>& size) {
  std::vector<std::vector<cv::Point2f>> pixels;
  std::vector<std::vector<cv::Point3f>> boards;
  for (const auto* view : views) {
    pixels.push_back(cv_points(view->corners));
    boards.push_back(cv_board(target, view->corners));
  }
  cv::Mat K, distortion, per_view;
  std::vector<cv::Mat> rotations, translations;
  try {
    cv::calibrateCamera(boards, pixels, cv::Size(size[0], size[1]), K, distortion, rotations, translations,
                        cv::noArray(), cv::noArray(), per_view, cv::CALIB_FIX_K3,
                        cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 1e-9));
  } catch (const cv::Exception&) {
    K.release();
  }
  if (K.empty() || !(K.at<double>(0, 0) > 0 && K.at<double>(0, 0) < 1e6))
    throw NotUsable(
        fmt::format("sensor {}: no camera explains the {} board views; tilt the board by 20 to 45 degrees to "
                    "different sides and check the number of corners and the pitch",
                    sensor, views.size()));
  CameraStart start;
  const cv::Mat k = K.reshape(1, 1);
  start.camera = {size[0], size[1], rounded(k, 0), rounded(k, 4), rounded(k, 2), rounded(k, 5), {}};
  for (int i = 0; i < 4; ++i) start.camera.distortion[static_cast<std::size_t>(i)] = rounded(distortion, i);
  for (std::size_t i = 0; i < views.size(); ++i) {
    start.cam_from_board.push_back(rigid(rotations[i], translations[i]));
    start.view_rms_px.push_back(per_view.at<double>(static_cast<int>(i)));
  }
  return start;
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
  return rounded(*pose);
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
