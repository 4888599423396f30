// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/truth_files.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "io/atomic_file.h"
#include "simulate/board_poses.h"
#include "simulate/scene_world.h"
#include "simulate/worn_wheel.h"

namespace lightstripe {
namespace {

constexpr double kDisturbing = 2;  // grey levels of a reflection

constexpr std::string_view kReadme = R"(# The truth of a simulated session

Units mm, px, grey levels. Pixel (0, 0) is the centre of the top-left pixel. "Rig frame" is the frame of the rig at
travel 0 that a perfect calibration finds: origin in the first sensor's projection centre, x = travel, z = the up hint of
calibration.yaml made orthogonal to x, y = z cross x. Without a motion calibration x is the first laser plane's normal.

- `scene.yaml`: the whole scene, defaults written out; `lightstripe simulate` makes the same bits from it.
- `rig.yaml`: the true rig in the format of a calibrated one (cameras, laser planes, rig_from_camera, motion).
- `poses.csv`: `name,qw,qx,qy,qz,x,y,z` — rig_from_board of each board pose; `name` is the images' name without
  extension ("000"), "travel" the fixed board of the motion calibration at travel 0. Board frame: origin in the first
  inner corner, x along the longer given side of the pattern (`inner_corners[0]`), y to the next row, z into the board;
  the square beyond the first inner corner (x < 0, y < 0) is white, which is where cv::findChessboardCornersSB begins.
- `stripes.csv`: `image,sensor,frame,x,y,X,Y,Z,level,blob` — the middle of the laser sheet on the surfaces where it is lit,
  seen by the camera and inside the image; computed from geometry alone. Rows in order along the laser's fan, about
  0.5 px apart; a larger step is a gap or a jump to another surface. `frame` is -1 for board images. x, y: pixel by the
  camera model. X, Y, Z: rig frame at travel 0 (where `moves: object`, the object as it lay at travel 0). `level`: what the laser adds there before the lens' blur
  (faint where the light grazes a surface or at the fan's edge). `blob`: 1 where a reflection adds more than 2 grey levels.
- `sections.csv`: `frame,travel,u,v` — the outline of the rail that the frame sees, u = y, v = z of the rig frame, in order
  along the outline (counterclockwise from the top), closed, first point not repeated, not farther apart than
  `scan.truth_spacing_mm`. Only where the scene has a rail.
  Of a wheel: u = position along the axis from the axis' point nearest to the rig's origin (truth/rig.yaml), v = radius, from the
  field side's inner end over tread and flange to the back. None where the rig is led by hand (`scan: sway`).
- `wear.csv` of a rail: `frame,travel,vertical_wear,side_wear` — how much lower the rail is on its centreline and how far the gauge
  face (`rail.gauge_side`) lies further in, both in the rail's own frame. Of a wheel: `frame,travel,flange_height,flange_thickness,qr,tread_wear,
  hollow,rim_width,diameter` of the section by railway practice (datum 70 mm from the back, thickness 10 mm above the datum, qR
  down from 2 mm below the tip); hollow = largest rise of the tread towards the field side; diameter at the datum.
- `other_sections.csv`, `other_wear.csv`: the same of a track's second rail (`other_rail`).
)";

struct SectionTables {
  std::string sections, wear;
};

SectionTables rail_sections(const Scene& scene, const RailObject& rail, const Outline& nominal,
                            const Rigid3& rig_from_world) {
  SectionTables out{"frame,travel,u,v\n", "frame,travel,vertical_wear,side_wear\n"};
  const Rigid3 rig_from_rail = rig_from_world * world_from_rail(rail);
  for (int frame = 0; frame < scene.scan.frames; ++frame) {
    const double travel = travel_of(scene, frame);
    for (const OutlineSample& point :
         sample(rail_outline(rail, scene.scan, nominal, frame), scene.scan.truth_spacing_mm)) {
      const Eigen::Vector3d p = rig_from_rail * Eigen::Vector3d(0, point.position.x(), point.position.y());
      fmt::format_to(std::back_inserter(out.sections), "{},{},{:.6f},{:.6f}\n", frame, travel, p.y(), p.z());
    }
    const RailWear wear = wear_at(rail, scene.scan, frame);
    fmt::format_to(std::back_inserter(out.wear), "{},{},{},{}\n", frame, travel, wear.vertical_mm,
                   wear.side_mm);
  }
  return out;
}

/// How far the section's axis stands off the turning one, towards where the first laser meets the wheel.
/// `across` gets what is left of it.
double offset_towards_laser(const Scene& scene, int frame, double& across) {
  const Eigen::Vector3d axis = scene.wheel.axis.normalized();
  const Eigen::Vector3d aim = scene.sensors.front().laser.aim - scene.wheel.center;
  const Eigen::Vector3d lit =
      moved_in_scan(scene, frame).rotation * (aim - axis.dot(aim) * axis).normalized();
  const Eigen::Vector3d offset = world_from_wheel(scene).translation - scene.wheel.center;
  across = (offset - offset.dot(lit) * lit).norm();
  return offset.dot(lit);
}

SectionTables wheel_sections(const Scene& scene, const Outline& nominal, const Rig& rig,
                             const Rigid3& rig_from_world) {
  SectionTables out{"frame,travel,u,v\n",
                    "frame,travel,flange_height,flange_thickness,qr,tread_wear,hollow,rim_width,diameter\n"};
  const Motion& motion = rig.motion;
  const double datum_u = motion.axis_direction.dot(rig_from_world * scene.wheel.center - motion.axis_point);
  const double side = motion.axis_direction.dot(rig_from_world.rotation * scene.wheel.axis) > 0 ? 1 : -1;
  const Outline section = wheel_outline(scene, nominal);
  const WheelDimensions size = measure_wheel_section(section);
  const auto points = sample(section, scene.scan.truth_spacing_mm);
  const double radius = scene.wheel.diameter_mm / 2;
  for (int frame = 0; frame < scene.scan.frames; ++frame) {
    double across = 0;
    const double towards = offset_towards_laser(scene, frame, across);
    const double travel = travel_of(scene, frame);
    for (const OutlineSample& point : points) {
      const double r = radius + point.position.y();
      fmt::format_to(std::back_inserter(out.sections), "{},{},{:.6f},{:.6f}\n", frame, travel,
                     datum_u + side * point.position.x(), towards + std::sqrt(r * r - across * across));
    }
    fmt::format_to(std::back_inserter(out.wear), "{},{},{:.6f},{:.6f},{:.6f},{},{:.6f},{:.6f},{}\n", frame,
                   travel, size.flange_height, size.flange_thickness, size.qr, scene.wheel.tread_wear_mm,
                   size.hollow, size.rim_width, 2 * (radius - scene.wheel.tread_wear_mm));
  }
  return out;
}

}  // namespace

std::string stripe_rows(const std::string& image, const std::string& sensor, int frame,
                        const std::vector<StripeTruth>& points, const Rigid3& rig_from_world,
                        const std::vector<Blob>& blobs, const Reflections& plan) {
  std::string out;
  for (const StripeTruth& point : points) {
    double glare = 0;
    for (const Blob& blob : blobs)
      glare += plan.peak * blob.cover(point.pixel.x(), point.pixel.y(), plan.edge_px);
    const Eigen::Vector3d p = rig_from_world * point.position;
    fmt::format_to(std::back_inserter(out), "{},{},{},{:.5f},{:.5f},{:.6f},{:.6f},{:.6f},{:.2f},{}\n", image,
                   sensor, frame, point.pixel.x(), point.pixel.y(), p.x(), p.y(), p.z(), point.level,
                   glare > kDisturbing ? 1 : 0);
  }
  return out;
}

void write_poses(const std::filesystem::path& path, const std::vector<NamedPose>& poses) {
  std::string out = "name,qw,qx,qy,qz,x,y,z\n";
  for (const NamedPose& pose : poses) {
    const Eigen::Quaterniond& q = pose.rig_from_board.rotation;
    const Eigen::Vector3d& t = pose.rig_from_board.translation;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{}\n", pose.name, q.w(), q.x(), q.y(),
                   q.z(), t.x(), t.y(), t.z());
  }
  write_file(path, out);
}

void write_sections(const std::filesystem::path& folder, const Scene& scene, const NominalOutlines& nominal,
                    const Rig& rig, const Rigid3& rig_from_world) {
  if (scene.has_poses()) return;
  const auto write = [&](const SectionTables& tables, const std::string& prefix) {
    write_file(folder / (prefix + "sections.csv"), tables.sections);
    write_file(folder / (prefix + "wear.csv"), tables.wear);
  };
  if (scene.rail.present()) write(rail_sections(scene, scene.rail, nominal.main, rig_from_world), "");
  if (scene.wheel.present()) write(wheel_sections(scene, nominal.main, rig, rig_from_world), "");
  if (scene.other_rail.present())
    write(rail_sections(scene, scene.other_rail, nominal.other_rail, rig_from_world), "other_");
}

void write_truth_readme(const std::filesystem::path& path) { write_file(path, kReadme); }

}  // namespace lightstripe
