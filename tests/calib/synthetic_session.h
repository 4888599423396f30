// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Known two-sensor rail rigs and what they would observe: for the tests of calib. No images, only
// measurements.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "calib/adjust/board_surface.h"
#include "calib/adjust/rig_state.h"
#include "calib/calibrate_rig.h"
#include "calib/observations.h"
#include "core/random.h"

namespace lightstripe::testing {

struct SyntheticRig {
  Target target;
  std::vector<SensorState> sensors;  ///< cam_from_first, one laser plane each
  Eigen::Vector3d direction;         ///< of travel, first frame
  double range_mm = 550;
};

/// Sensors around a section: the first looks along z at (0, 0, range); the next stand turned by 55 degrees
/// about the direction of travel. Laser planes 0.5 degrees and 1 mm beside each other. The details depend on
/// the seed.
inline SyntheticRig rail_rig(int num_sensors = 2, std::uint64_t seed = 0) {
  Random random(seed, 1000);
  SyntheticRig rig;
  rig.target.columns = 11;
  rig.target.rows = 8;
  rig.target.pitch_x = rig.target.pitch_y = 10;
  const double slant = (40 + random.uniform(-5, 5)) * kDegree;
  const Eigen::Vector3d travel(0.02, std::cos(slant), std::sin(slant));
  rig.direction =
      (travel + 0.03 * Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0)).normalized();
  const Eigen::Vector3d centre(0, 0, rig.range_mm);
  for (int i = 0; i < num_sensors; ++i) {
    SensorState sensor;
    sensor.camera = {960,
                     700,
                     1640 + random.uniform(-30, 30),
                     1640 + random.uniform(-30, 30),
                     480 + random.uniform(-10, 10),
                     350 + random.uniform(-10, 10),
                     {}};
    sensor.camera.distortion = {-0.09 + random.uniform(-0.02, 0.02), 0.12, 4e-4 * random.uniform(-1, 1),
                                4e-4 * random.uniform(-1, 1), -0.05};
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(i * 55 * kDegree, travel.normalized()));
    sensor.cam_from_first = {turn, centre - turn * centre};
    const Eigen::Vector3d normal =
        (travel.normalized() +
         0.01 * Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)))
            .normalized();
    sensor.laser_planes.push_back({normal, normal.dot(centre) + random.uniform(-1, 1)});
    rig.sensors.push_back(sensor);
  }
  return rig;
}

struct SessionOptions {
  int poses = 20;
  double max_tilt_deg = 32;
  double corner_noise_px = 0.07, stripe_noise_px = 0.1;
  double stripe_width_px = 6;  ///< the points lie that far apart: independent
  int travel_steps = 6;        ///< 0: no motion
  double travel_mm = 60;       ///< from first to last
  std::uint64_t seed = 0;
  Eigen::Vector2d board_warp_mm = Eigen::Vector2d::Zero();
};

inline SessionOptions perfect(int poses = 10) {
  SessionOptions options;
  options.poses = poses;
  options.corner_noise_px = options.stripe_noise_px = 0;
  return options;
}

inline SessionOptions noisy(int poses = 20, std::uint64_t seed = 0) {
  SessionOptions options;
  options.poses = poses;
  options.seed = seed;
  return options;
}

inline CalibrationResult calibrate_with_warp(const CalibrationObservations& observations) {
  CalibrationOptions options;
  options.board_warp = true;
  return calibrate_rig(observations, options);
}

/// Faces the middle between the sensors, then tilted, turned and shifted at random.
inline Rigid3 random_board(const SyntheticRig& rig, const SessionOptions& options, Random& random) {
  const double fan = (static_cast<double>(rig.sensors.size()) - 1) * 0.5 * 55 * kDegree;
  const double t = options.max_tilt_deg * kDegree;
  const Eigen::Quaterniond towards(Eigen::AngleAxisd(-fan, rig.sensors.back().laser_planes.front().normal));
  const Eigen::Quaterniond q = towards * Eigen::AngleAxisd(random.uniform(-t, t), Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(random.uniform(-t, t), Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(random.uniform(-0.5, 0.5), Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d centre(random.uniform(-40, 40), random.uniform(-25, 25),
                               rig.range_mm + random.uniform(-50, 50));
  const Eigen::Vector3d middle(0.5 * (rig.target.columns - 1) * rig.target.pitch_x,
                               0.5 * (rig.target.rows - 1) * rig.target.pitch_y, 0);
  return {q, centre - q * middle};
}

inline std::vector<Eigen::Vector2d> seen_corners(const Target& target, const Camera& camera,
                                                 const Rigid3& cam_from_board,
                                                 const Eigen::Vector2d& warp_mm = Eigen::Vector2d::Zero()) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < target.num_corners(); ++i) {
    const auto q = project(camera, cam_from_board * board_place(target, target.corner(i)).point(warp_mm));
    corners.push_back(q.value_or(Eigen::Vector2d(-1, -1)));
  }
  return corners;
}

inline bool inside(const Camera& camera, const Eigen::Vector2d& q) {
  return q.x() > 0 && q.y() > 0 && q.x() < camera.width - 1 && q.y() < camera.height - 1;
}

/// A point of the laser plane on the flat board, moved within the laser plane to the warped one.
inline Eigen::Vector3d on_warped_board(const Target& target, const Rigid3& cam_from_board, const Plane& laser,
                                       const StripeLine& line, Eigen::Vector3d p_cam,
                                       const Eigen::Vector2d& warp_mm) {
  const Rigid3 board_from_cam = cam_from_board.inverse();
  const Eigen::Vector3d up = laser.normal.cross(line.direction);
  const double rise = (board_from_cam.rotation * up).z();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = board_from_cam * p_cam;
    p_cam += (board_place(target, p.head<2>()).weights.dot(warp_mm) - p.z()) / rise * up;
  }
  return p_cam;
}

/// Where the laser crosses the board, as exact stripe points of unit-less width.
inline std::vector<StripePoint> seen_stripe(const Target& target, const SensorState& sensor,
                                            const Rigid3& cam_from_board, double spacing_px,
                                            const Eigen::Vector2d& warp_mm = Eigen::Vector2d::Zero(),
                                            std::size_t plane = 0) {
  std::vector<StripePoint> points;
  const auto line = stripe_line(board_plane(cam_from_board), sensor.laser_planes[plane]);
  if (!line) return points;
  const Rigid3 board_from_cam = cam_from_board.inverse();
  constexpr double kStep_mm = 0.5;  // while off the board
  double step_mm = kStep_mm;
  for (double s = -400; s < 400; s += step_mm) {
    const Eigen::Vector3d p_cam = on_warped_board(target, cam_from_board, sensor.laser_planes[plane], *line,
                                                  line->point + s * line->direction, warp_mm);
    const Eigen::Vector3d p = board_from_cam * p_cam;
    const bool on_board = p.x() > -target.pitch_x && p.x() < target.columns * target.pitch_x &&
                          p.y() > -target.pitch_y && p.y() < target.rows * target.pitch_y;
    const auto q = project(sensor.camera, p_cam),
               next = project(sensor.camera, p_cam + 0.02 * line->direction);
    step_mm = kStep_mm;
    if (!on_board || !q || !next || !inside(sensor.camera, *q)) continue;
    const Eigen::Vector2d tangent = (*next - *q).normalized();
    step_mm = spacing_px * 0.02 / (*next - *q).norm();
    StripePoint point;
    point.x = q->x();
    point.y = q->y();
    point.normal_x = -tangent.y();
    point.normal_y = tangent.x();
    point.width = spacing_px;
    points.push_back(point);
  }
  return points;
}

inline void add_noise(BoardView& view, const SessionOptions& options, Random& random) {
  for (auto& corner : view.corners)
    corner += options.corner_noise_px * Eigen::Vector2d(random.gaussian(), random.gaussian());
  for (auto& stripe : view.stripes) {
    for (auto& point : stripe) {
      const double shift = options.stripe_noise_px * random.gaussian();
      point.x += shift * point.normal_x;
      point.y += shift * point.normal_y;
      point.sigma_px = options.stripe_noise_px;
      point.width = 0.9 * options.stripe_width_px;  // noise must not make neighbours closer than a width
    }
  }
}

/// A pose that all sensors see in full.
inline Rigid3 visible_board(const SyntheticRig& rig, const SessionOptions& options, Random& random) {
  for (;;) {
    const Rigid3 first_from_board = random_board(rig, options, random);
    const bool visible = std::all_of(rig.sensors.begin(), rig.sensors.end(), [&](const SensorState& sensor) {
      const auto corners = seen_corners(rig.target, sensor.camera, sensor.cam_from_first * first_from_board);
      return std::all_of(corners.begin(), corners.end(),
                         [&](const auto& q) { return inside(sensor.camera, q); });
    });
    if (visible) return first_from_board;
  }
}

inline MotionObservations observe_travel(const SyntheticRig& rig, const SessionOptions& options,
                                         Random& random) {
  MotionObservations motion;
  const auto& sensor = rig.sensors.front();
  const Rigid3 board = visible_board(rig, {.max_tilt_deg = 10}, random);
  for (int i = 0; i < options.travel_steps; ++i) {
    const double travel = options.travel_mm * (i / (options.travel_steps - 1.0) - 0.5);
    Rigid3 seen = sensor.cam_from_first * board;
    seen.translation -= sensor.cam_from_first.rotation * (travel * rig.direction);
    BoardView view;
    view.image = "travel_" + std::to_string(i);
    view.corners = seen_corners(rig.target, sensor.camera, seen, options.board_warp_mm);
    add_noise(view, options, random);
    motion.views.push_back(view);
    motion.travel.push_back(travel);
  }
  return motion;
}

/// The session's board poses, first frame.
inline std::vector<Rigid3> board_poses(const SyntheticRig& rig, const SessionOptions& options) {
  Random random(options.seed, 6);
  std::vector<Rigid3> poses;
  for (int i = 0; i < options.poses; ++i) poses.push_back(visible_board(rig, options, random));
  return poses;
}

inline CalibrationObservations observe(const SyntheticRig& rig, const SessionOptions& options = {}) {
  Random random(options.seed, 7);
  const auto poses = board_poses(rig, options);
  CalibrationObservations observations;
  observations.target = rig.target;
  for (std::size_t s = 0; s < rig.sensors.size(); ++s)
    observations.sensors.push_back({s == 0   ? "gauge"
                                    : s == 1 ? "field"
                                             : "extra" + std::to_string(s),
                                    960,
                                    700,
                                    static_cast<int>(rig.sensors[s].laser_planes.size()),
                                    {},
                                    {}});
  for (int pose = 0; pose < options.poses; ++pose) {
    const Rigid3& first_from_board = poses[static_cast<std::size_t>(pose)];
    for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
      const Rigid3 cam_from_board = rig.sensors[s].cam_from_first * first_from_board;
      BoardView view;
      view.pose = std::to_string(pose);
      view.image = observations.sensors[s].name + "_" + view.pose;
      view.corners = seen_corners(rig.target, rig.sensors[s].camera, cam_from_board, options.board_warp_mm);
      for (std::size_t p = 0; p < rig.sensors[s].laser_planes.size(); ++p)
        view.stripes.push_back(seen_stripe(rig.target, rig.sensors[s], cam_from_board,
                                           options.stripe_width_px, options.board_warp_mm, p));
      add_noise(view, options, random);
      observations.sensors[s].views.push_back(view);
    }
  }
  if (options.travel_steps > 1) observations.motion = observe_travel(rig, options, random);
  return observations;
}

}  // namespace lightstripe::testing
