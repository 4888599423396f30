// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Frames of a live camera, one by one, to heights in mm; what the loop needs is allocated in the first frame
// only.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "reconstruct/triangulate.h"

namespace {

using namespace lightstripe;

constexpr double kTable_mm = 300;  // from the camera, which looks straight down on it

/// In practice read_rig("rig.yaml") of io/rig_file.h. The laser sheet leans by 30 degrees and meets the table
/// below the camera.
Rig rig_above_a_table() {
  Sensor sensor;
  sensor.name = "top";
  sensor.camera = {640, 480, 800, 800, 320, 240, {}};
  const double lean = std::numbers::pi / 6;
  sensor.laser_planes = {{{0, -std::cos(lean), std::sin(lean)}, kTable_mm * std::sin(lean)}};
  sensor.rig_from_camera.rotation =
      rig_rotation({0, 1, 0}, {0, 0, -1});  // travel = down in the picture, up = towards us
  Rig rig;
  rig.sensors = {sensor};
  rig.motion.type = MotionType::kLinear;
  return rig;
}

/// Stands for your camera's driver: a block, 20 mm high, comes below the laser in frame 3.
Image8 grab(int frame, const Rig& rig) {
  const Camera& camera = rig.sensors[0].camera;
  const Plane& laser = rig.sensors[0].laser_planes[0];
  const double z = kTable_mm - (frame >= 3 ? 20 : 0);
  const double y = (laser.offset - laser.normal.z() * z) / laser.normal.y();
  const double row = project(camera, Eigen::Vector3d(0, y, z))->y();
  Image8 picture(camera.width, camera.height);
  for (int v = 0; v < picture.height; ++v)
    for (int u = 0; u < picture.width; ++u)
      picture(u, v) = static_cast<std::uint8_t>(15 + 200 * std::exp(-(v - row) * (v - row) / 6));
  return picture;
}

}  // namespace

int main() {
  const Rig rig = rig_above_a_table();
  ExtractionOptions options;
  options.stripe_width = 6;
  ExtractionWorkspace workspace;  // one a thread
  ExtractionResult extracted;
  Profile profile;
  for (int frame = 0; frame < 6; ++frame) {
    extract_stripes(grab(frame, rig), options, workspace, extracted);
    profile.frame = frame;
    profile.travel = 0.5 * frame;  // mm, from your encoder
    profile.points.clear();
    triangulate_stripes(extracted.stripes, rig, 0, {profile.travel, {}}, profile);

    double height = 0;
    for (const ProfilePoint& point : profile.points)
      height += (kTable_mm + point.v) / static_cast<double>(profile.points.size());
    fmt::print("frame {}: {} points, height {:.2f} mm\n", frame, profile.points.size(), height);
  }
}
