// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Corners and stripe points that you measured yourself (another board, another detector) to a calibrated rig.
#include <fmt/format.h>

#include <cmath>

#include "calib/calibrate_rig.h"
#include "core/random.h"
#include "io/rig_file.h"

namespace {

using namespace lightstripe;

const Camera kTrueCamera{960, 700, 1640, 1640, 480, 350, {-0.08, 0.1, 2e-4, -1e-4, 0}};
const Plane kTrueLaser{Eigen::Vector3d(0, 0.8, 0.6), 330};

constexpr double kNoise_px = 0.05;

/// One pose of the board: in practice what your detector found in one picture.
BoardView observe(const Target& target, const Rigid3& cam_from_board, Random& random) {
  BoardView view;
  for (int i = 0; i < target.num_corners(); ++i) {
    const Eigen::Vector2d p = target.corner(i);
    const Eigen::Vector2d noise(random.gaussian(), random.gaussian());
    view.corners.push_back(*project(kTrueCamera, cam_from_board * Eigen::Vector3d(p.x(), p.y(), 0)) +
                           kNoise_px * noise);
  }
  // The laser crosses the board where normal . (R (x, y, 0) + t) = offset: for each x one y.
  const Eigen::Vector3d normal = cam_from_board.rotation.conjugate() * kTrueLaser.normal;
  const double offset = -kTrueLaser.signed_distance(cam_from_board.translation);
  std::vector<StripePoint> stripe;
  for (double x = 0; x <= (target.columns - 1) * target.pitch_x; x += 2) {
    const auto at = [&](double along) {
      return *project(kTrueCamera,
                      cam_from_board * Eigen::Vector3d(along, (offset - normal.x() * along) / normal.y(), 0));
    };
    const Eigen::Vector2d across = (at(x + 0.1) - at(x)).unitOrthogonal();
    const Eigen::Vector2d p = at(x) + kNoise_px * random.gaussian() * across;
    StripePoint point{p.x(), p.y(), across.x(), across.y()};
    point.width = 4;
    point.sigma_px = kNoise_px;
    stripe.push_back(point);
  }
  view.stripes = {stripe};
  return view;
}

CalibrationObservations own_observations() {
  Random random(1);
  CalibrationObservations observations;
  observations.target = {TargetType::kCheckerboard, 11, 8, 10, 10};
  SensorObservations sensor{"solo", kTrueCamera.width, kTrueCamera.height, 1, {}};
  const Eigen::Vector3d middle(50, 35, 0);
  for (const double tilt_x : {-30.0, 0.0, 30.0})
    for (const double tilt_y : {-30.0, 0.0, 30.0})
      for (const double distance : {500.0, 580.0}) {
        const Eigen::Quaterniond turn = Eigen::AngleAxisd(tilt_x * kDegree, Eigen::Vector3d::UnitX()) *
                                        Eigen::AngleAxisd(tilt_y * kDegree, Eigen::Vector3d::UnitY());
        // Where the laser meets the optical axis it has to cross the board: 330 / 0.6 = 550 mm.
        const Eigen::Vector3d place(0, (330 - 0.6 * distance) / 0.8, distance);
        BoardView view = observe(observations.target, {turn, place - turn * middle}, random);
        view.pose = view.image = fmt::format("{}/{}/{}", tilt_x, tilt_y, distance);
        sensor.views.push_back(view);
      }
  observations.sensors = {sensor};
  return observations;
}

}  // namespace

int main() {
  const CalibrationResult result = calibrate_rig(own_observations());
  if (!result.summary.usable) {
    fmt::print("not usable: {}\n", result.summary.message);
    return 3;
  }
  const Sensor& sensor = result.rig.sensors[0];
  const Plane& laser = sensor.laser_planes[0];
  fmt::print("{}", rig_to_yaml(result.rig));  // or write_file("rig.yaml", ...) of io/atomic_file.h
  fmt::print("# corners rms {:.4f} px, f = {:.2f} px\n", result.rig.quality.sensors[0].board_rms_px,
             sensor.camera.fx);
  fmt::print("# laser plane {:.4f} deg and {:.4f} mm from the true one\n",
             std::acos(std::min(1.0, laser.normal.dot(kTrueLaser.normal))) / kDegree,
             std::abs(laser.offset - kTrueLaser.offset));
}
