// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/board_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/error.h"
#include "core/random.h"
#include "core/transform.h"
#include "simulate/scene_world.h"

namespace lightstripe {
namespace {

using Eigen::Vector3d;

constexpr double kGoldenAngle = 137.50776405003785 * kDegree;  // spreads the tilts' directions evenly
constexpr int kAttempts = 20000;
constexpr std::uint64_t kPoseStream = 0x706f7365;  // apart from the images' noise
// Limits within which detectors and the stripe's extraction work well.
constexpr double kMaxViewAngleDeg = 58;   // line of sight against the board's normal
constexpr double kMaxIncidenceDeg = 68;   // light against the normal
constexpr double kMinSheetAngleDeg = 22;  // board against the laser sheet
constexpr double kMinStripe = 0.5;        // of the pattern's shorter side

Vector3d outwards(const Rigid3& world_from_board) { return -(world_from_board.rotation * Vector3d::UnitZ()); }

/// The pattern's four outer corners (with the outermost squares), board frame.
std::array<Vector3d, 4> outer_corners(const Target& target) {
  const double x0 = -target.pitch_x, x1 = target.columns * target.pitch_x;
  const double y0 = -target.pitch_y, y1 = target.rows * target.pitch_y;
  return {Vector3d(x0, y0, 0), Vector3d(x1, y0, 0), Vector3d(x1, y1, 0), Vector3d(x0, y1, 0)};
}

Vector3d middle_of(const Target& target) {
  return {0.5 * (target.columns - 1) * target.pitch_x, 0.5 * (target.rows - 1) * target.pitch_y, 0};
}

/// A board whose middle lies at `middle`, tilted by `tilt` against facing `viewer`, about an axis at
/// `azimuth`, and rolled. Without tilt and roll the board's x is level.
Rigid3 held(const Target& target, const Vector3d& middle, const Vector3d& viewer, double tilt, double azimuth,
            double roll) {
  Eigen::Matrix3d facing;
  facing.col(2) = -viewer;
  facing.col(0) = Vector3d(-viewer).cross(Vector3d::UnitZ()).normalized();
  facing.col(1) = facing.col(2).cross(facing.col(0));
  const Eigen::AngleAxisd tilted(tilt, Vector3d(std::cos(azimuth), std::sin(azimuth), 0));
  const Eigen::AngleAxisd rolled(roll, Vector3d::UnitZ());
  const Eigen::Quaterniond rotation = (Eigen::Quaterniond(facing) * tilted * rolled).normalized();
  return {rotation, middle - rotation * middle_of(target)};
}

bool whole_in_view(const View& view, const Target& target, const Rigid3& pose, double margin_px) {
  const Camera& camera = view.sensor->camera;
  return std::ranges::all_of(outer_corners(target), [&](const Vector3d& corner) {
    const auto pixel = pixel_of(view, pose * corner);
    return pixel && pixel->x() >= margin_px && pixel->y() >= margin_px &&
           pixel->x() <= camera.width - 1 - margin_px && pixel->y() <= camera.height - 1 - margin_px;
  });
}

bool seen_well(const View& view, const Target& target, const Rigid3& pose) {
  const Vector3d sight = (view.eye() - pose * middle_of(target)).normalized();
  return outwards(pose).dot(sight) > std::cos(kMaxViewAngleDeg * kDegree);
}

/// Where the sheet cuts the pattern's rim, the two points' distance, mm.
double stripe_length(const SimulatedSensor& sensor, const Target& target, const Rigid3& pose) {
  std::vector<Vector3d> cuts;
  const auto corners = outer_corners(target);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d a = pose * corners[i], b = pose * corners[(i + 1) % 4];
    const double da = sensor.sheet.signed_distance(a), db = sensor.sheet.signed_distance(b);
    if ((da < 0) != (db < 0)) cuts.push_back(a + da / (da - db) * (b - a));
  }
  return cuts.size() == 2 ? (cuts[0] - cuts[1]).norm() : 0;
}

bool lit_well(const SimulatedSensor& sensor, const Target& target, const Rigid3& pose) {
  const Vector3d normal = outwards(pose), to_source = (sensor.source - pose * middle_of(target)).normalized();
  const double shorter = std::min((target.columns + 1) * target.pitch_x, (target.rows + 1) * target.pitch_y);
  return normal.dot(to_source) > std::cos(kMaxIncidenceDeg * kDegree) &&
         std::abs(normal.dot(sensor.sheet.normal)) < std::cos(kMinSheetAngleDeg * kDegree) &&
         stripe_length(sensor, target, pose) > kMinStripe * shorter;
}

/// Some corners in view, some not.
bool cut_by_image(const View& view, const Target& target, const Rigid3& pose) {
  int seen = 0;
  for (int i = 0; i < target.num_corners(); ++i) {
    const Eigen::Vector2d corner = target.corner(i);
    seen += pixel_of(view, pose * Vector3d(corner.x(), corner.y(), 0)).has_value();
  }
  return 2 * seen > target.num_corners() && seen < target.num_corners();
}

/// The direction from a place towards the middle of the cameras.
Vector3d towards_cameras(std::span<const SimulatedSensor> sensors, const Vector3d& from) {
  Vector3d sum = Vector3d::Zero();
  for (const SimulatedSensor& sensor : sensors)
    sum += (sensor.world_from_camera.translation - from).normalized();
  return sum.normalized();
}

Rigid3 draw(const BoardPlan& plan, std::span<const SimulatedSensor> sensors, double azimuth, Random& random) {
  const Vector3d offset(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  const Vector3d middle = plan.center + plan.spread.cwiseProduct(offset);
  const double tilt = random.uniform(0.25, 1) * plan.max_tilt_deg * kDegree;
  const double roll = random.uniform(-1, 1) * plan.max_roll_deg * kDegree;
  return held(target_of(plan), middle, towards_cameras(sensors, middle), tilt,
              azimuth + random.uniform(-0.6, 0.6), roll);
}

bool usable(const Scene& scene, const std::vector<SimulatedSensor>& sensors, const Rigid3& pose,
            bool cut_off) {
  const Target target = target_of(scene.boards);
  for (const SimulatedSensor& sensor : sensors) {
    const View view{&sensor, {}, 0, 0};
    const bool framed = cut_off && &sensor == &sensors.front()
                            ? cut_by_image(view, target, pose)
                            : whole_in_view(view, target, pose, scene.boards.margin_px);
    if (!framed || !seen_well(view, target, pose) || !lit_well(sensor, target, pose)) return false;
  }
  return true;
}

bool usable_in_motion(const Scene& scene, const SimulatedSensor& sensor, const Rigid3& pose) {
  for (int i = 0; i < scene.motion.positions; ++i) {
    const View view{&sensor, moved_in_motion(scene, i), 0, 0};
    const Target target = target_of(scene.boards);
    if (!whole_in_view(view, target, pose, scene.boards.margin_px) || !seen_well(view, target, pose))
      return false;
  }
  return true;
}

}  // namespace

Target target_of(const BoardPlan& plan) {
  Target target;
  target.columns = plan.inner_corners[0];
  target.rows = plan.inner_corners[1];
  target.pitch_x = plan.square_mm[0];
  target.pitch_y = plan.square_mm[1];
  return target;
}

BoardSurface make_board(const BoardPlan& plan, const Rigid3& world_from_board) {
  return {world_from_board, target_of(plan), plan.quiet_border_mm, plan.white_albedo, plan.black_albedo};
}

Rigid3 moved_at(const Scene& scene, double travel) {
  const double signed_travel = sign_of(scene.motion.moves) * travel;
  if (!scene.turns()) return {Eigen::Quaterniond::Identity(), signed_travel * Vector3d::UnitX()};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(signed_travel * kDegree, turning_axis(scene)));
  return {turn, scene.wheel.center - turn * scene.wheel.center};
}

Rigid3 moved_in_motion(const Scene& scene, int position) {
  return moved_at(scene, position * (scene.turns() ? scene.motion.step_deg : scene.motion.step_mm));
}

Rigid3 moved_in_scan(const Scene& scene, int frame) {
  Rigid3 moved = moved_at(scene, travel_of(scene, frame));
  if (!scene.has_poses()) return moved;
  // Three periods without a common measure: no frame repeats another, and frame 0 stands where travel 0 is.
  const auto sway = [frame](double periods) { return std::sin(2 * std::numbers::pi * frame / periods); };
  const Vector3d turned = scene.scan.sway_deg * kDegree * Vector3d(sway(17.3), sway(23.9), sway(31.7));
  const double angle = turned.norm();
  if (angle > 0) moved.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, turned / angle));
  const Vector3d middle = scene.boards.center;  // turns about what it looks at
  moved.translation +=
      middle - moved.rotation * middle + scene.scan.sway_mm * Vector3d(0, sway(19.1), sway(27.7));
  return moved;
}

std::size_t motion_sensor(const Scene& scene) {
  for (std::size_t i = 0; i < scene.sensors.size(); ++i)
    if (scene.sensors[i].name == scene.motion.sensor) return i;
  return 0;
}

std::vector<Rigid3> draw_board_poses(const Scene& scene, const std::vector<SimulatedSensor>& sensors) {
  std::vector<Rigid3> poses;
  for (int i = 0; i < scene.boards.count; ++i) {
    Random random(static_cast<std::uint64_t>(scene.seed), kPoseStream + static_cast<std::uint64_t>(i));
    const bool cut_off = i >= scene.boards.count - scene.boards.cut_off;
    for (int attempt = 0; attempt < kAttempts && static_cast<int>(poses.size()) == i; ++attempt) {
      const Rigid3 pose = draw(scene.boards, sensors, i * kGoldenAngle, random);
      if (usable(scene, sensors, pose, cut_off)) poses.push_back(pose);
    }
    if (static_cast<int>(poses.size()) == i)
      throw Error("boards", "no pose found that all sensors see whole and all lasers cross",
                  "move boards.center, or give a smaller board or larger images");
  }
  return poses;
}

Rigid3 draw_motion_board(const Scene& scene, const std::vector<SimulatedSensor>& sensors) {
  const SimulatedSensor& sensor = sensors[motion_sensor(scene)];
  Random random(static_cast<std::uint64_t>(scene.seed), kPoseStream - 1);
  BoardPlan plan = scene.boards;
  const double last =
      (scene.motion.positions - 1) * (scene.turns() ? scene.motion.step_deg : scene.motion.step_mm);
  plan.center = moved_at(scene, 0.5 * last) * plan.center;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Rigid3 pose = draw(plan, {&sensor, 1}, attempt * kGoldenAngle, random);
    if (usable_in_motion(scene, sensor, pose)) return pose;
  }
  throw Error("motion", "no board's pose found that stays in view over the whole travel",
              "shorten motion.positions x motion.step_mm, or give a smaller board");
}

}  // namespace lightstripe
