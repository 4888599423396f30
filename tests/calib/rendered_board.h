// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A small renderer of one checkerboard for the tests of calib: exact camera model, area sampling, lens blur,
// noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "core/board.h"
#include "core/camera.h"
#include "core/image.h"
#include "core/plane.h"
#include "core/random.h"
#include "core/transform.h"

namespace lightstripe::testing {

struct BoardLook {
  double dark = 40, light = 200, background = 90;  ///< grey levels
  double margin_mm = 10;                           ///< white rim around the outer squares
  double blur_px = 0.8;                            ///< lens, standard deviation
  double noise = 1.5;                              ///< grey levels
  double ambient = 1;                              ///< factor on the board's brightness
  double laser_peak = 0;           ///< added brightness per albedo 1 at the stripe's middle; 0 = off
  double laser_sigma_mm = 0.3;     ///< of the light sheet
  double laser_dark_albedo = 0.1;  ///< what the black squares reflect of the laser's light
  bool first_square_dark = true;   ///< the square between corners 0, 1 and the next row
};

/// A white plate in a dark place, whose laser line a scan sees.
inline BoardLook lit_plate(double grey, double laser_peak) {
  return {.dark = grey,
          .light = grey,
          .background = 10,
          .margin_mm = 0,
          .laser_peak = laser_peak,
          .laser_sigma_mm = 0.5,
          .laser_dark_albedo = 1};
}

namespace detail {

/// Albedo class at a point of the board: 0 off the board, 1 dark square, 2 light square or rim.
inline int square_at(const Target& target, double x, double y, const BoardLook& look) {
  const double i = std::floor(x / target.pitch_x), j = std::floor(y / target.pitch_y);
  if (i >= -1 && i < target.columns && j >= -1 && j < target.rows)
    return ((static_cast<int>(i + j + 4) % 2 == 0) == look.first_square_dark) ? 1 : 2;
  const double m = look.margin_mm;
  const bool rim = x > -target.pitch_x - m && x < target.columns * target.pitch_x + m &&
                   y > -target.pitch_y - m && y < target.rows * target.pitch_y + m;
  return rim ? 2 : 0;
}

inline double brightness(const Target& target, const Rigid3& cam_from_board, std::span<const Plane> lasers,
                         const BoardLook& look, double x, double y) {
  const int square = square_at(target, x, y, look);
  if (square == 0) return look.background * look.ambient;
  double value = look.ambient * (square == 1 ? look.dark : look.light);
  for (const Plane& laser : lasers) {
    const double d = laser.signed_distance(cam_from_board * Eigen::Vector3d(x, y, 0)) / look.laser_sigma_mm;
    value += look.laser_peak * (square == 1 ? look.laser_dark_albedo : 1.0) * std::exp(-0.5 * d * d);
  }
  return value;
}

/// Whether laser light reaches the pixel, whose left side's middle is `left`.
inline bool lit(const Rigid3& cam_from_board, std::span<const Plane> lasers, const BoardLook& look,
                const Eigen::Vector2d& left, const Eigen::Vector2d& dx, const Eigen::Vector2d& dy) {
  const Eigen::Vector2d middle = left + 0.5 * dx;
  const Eigen::Vector3d p = cam_from_board * Eigen::Vector3d(middle.x(), middle.y(), 0);
  return std::any_of(lasers.begin(), lasers.end(), [&](const Plane& laser) {
    return std::abs(laser.signed_distance(p)) < 5 * look.laser_sigma_mm + dx.norm() + dy.norm();
  });
}

/// Whether the pixel, whose left side's middle is `left`, shows one square only.
inline bool uniform(const Target& target, const BoardLook& look, const Eigen::Vector2d& left,
                    const Eigen::Vector2d& dx, const Eigen::Vector2d& dy) {
  const auto at = [&](double i, double j) {
    const Eigen::Vector2d p = left + i * dx + j * dy;
    return square_at(target, p.x(), p.y(), look);
  };
  const int first = at(0, -0.5);
  return at(1, -0.5) == first && at(0, 0.5) == first && at(1, 0.5) == first && at(0.5, 0) == first;
}

}  // namespace detail

/// What the camera sees of the board at cam_from_board, lit by the laser planes.
inline Image8 render_board(const Camera& camera, const Target& target, const Rigid3& cam_from_board,
                           const BoardLook& look = {}, std::uint64_t seed = 1,
                           std::span<const Plane> lasers = {}) {
  constexpr int kSub = 6;
  cv::Mat1f picture(camera.height, camera.width);
  const Rigid3 board_from_cam = cam_from_board.inverse();
  const auto on_board = [&](const Eigen::Vector2d& pixel) {
    const auto ray = unproject(camera, pixel);
    const Eigen::Vector3d direction = board_from_cam.rotation * ray.value_or(Eigen::Vector3d(10, 10, 1));
    const double s = -board_from_cam.translation.z() / direction.z();
    return Eigen::Vector2d((board_from_cam.translation + s * direction).head<2>());
  };
  for (int y = 0; y < camera.height; ++y) {
    Eigen::Vector2d left = on_board({-0.5, y}), low = on_board({-0.5, y + 1.0});
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d right = on_board({x + 0.5, y});
      const Eigen::Vector2d dx = right - left, dy = low - left;
      const bool edge = detail::lit(cam_from_board, lasers, look, left, dx, dy) ||
                        !detail::uniform(target, look, left, dx, dy);
      const int sub = edge ? kSub : 1;
      double sum = 0;
      for (int j = 0; j < sub; ++j) {
        for (int i = 0; i < sub; ++i) {
          const Eigen::Vector2d at = left + ((i + 0.5) / sub) * dx + ((j + 0.5) / sub - 0.5) * dy;
          sum += detail::brightness(target, cam_from_board, lasers, look, at.x(), at.y());
        }
      }
      picture(y, x) = static_cast<float>(sum / (sub * sub));
      left = right;
      low = left + dy;
    }
  }
  if (look.blur_px > 0) cv::GaussianBlur(picture, picture, {}, look.blur_px);
  Image8 image(camera.width, camera.height);
  Random random(seed);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x)
      image(x, y) = static_cast<std::uint8_t>(
          std::clamp(std::lround(picture(y, x) + look.noise * random.gaussian()), 0L, 255L));
  return image;
}

/// True corner pixels, in the order of Target::corner.
inline std::vector<Eigen::Vector2d> true_corners(const Camera& camera, const Target& target,
                                                 const Rigid3& cam_from_board) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < target.num_corners(); ++i) {
    const Eigen::Vector2d p = target.corner(i);
    corners.push_back(project(camera, cam_from_board * Eigen::Vector3d(p.x(), p.y(), 0)).value());
  }
  return corners;
}

/// A board whose middle is `centre` (camera frame, mm), facing the camera, then tilted about its x, y and
/// turned about z.
inline Rigid3 board_pose(const Target& target, const Eigen::Vector3d& centre, double tilt_x_deg,
                         double tilt_y_deg, double turn_deg) {
  const double deg = std::acos(-1.0) / 180;
  const Eigen::Quaterniond q = Eigen::AngleAxisd(tilt_x_deg * deg, Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(tilt_y_deg * deg, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(turn_deg * deg, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d middle(0.5 * (target.columns - 1) * target.pitch_x,
                               0.5 * (target.rows - 1) * target.pitch_y, 0);
  return {q, centre - q * middle};
}

}  // namespace lightstripe::testing
