// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/sensor_design.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace lightstripe {
namespace {

void check(const SensorDesign& d) {
  const auto refuse = [](const char* option, double value, const char* rule) {
    throw Error(option, fmt::format("{:g} makes no sensor", value), rule);
  };
  if (!(d.distance_mm > 0)) refuse("--distance", d.distance_mm, "give a distance above 0 mm");
  if (!(d.angle_deg > 0 && d.angle_deg < 90))
    refuse("--angle", d.angle_deg, "give an angle between 0 and 90 degrees");
  if (!(d.focal_px > 0))
    refuse("--focal", d.focal_px, "give the focal length in pixels: mm of the lens over mm a pixel");
  if (!(d.along_px > 0 && d.across_px > 0)) refuse("--image", d.across_px, "give the image as 960x700");
  if (!(d.noise_px >= 0)) refuse("--noise", d.noise_px, "give an error of 0 px or more");
}

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Where the ray `slope` (pixels over focal length, + towards the camera's end) meets the plane.
double height_at(const SensorDesign& d, double slope) {
  const double s = std::sin(radians(d.angle_deg)), c = std::cos(radians(d.angle_deg));
  const double below = s + slope * c;
  return below > 0 ? slope * d.distance_mm / below : -std::numeric_limits<double>::infinity();
}

DesignPlace place_at(const SensorDesign& d, double height) {
  const double s = std::sin(radians(d.angle_deg)),
               depth = d.distance_mm - height * std::cos(radians(d.angle_deg));
  DesignPlace place;
  place.height_mm = height;
  place.along_mm_px = depth / d.focal_px;
  place.width_mm = place.along_mm_px * d.along_px;
  place.across_mm_px = depth * depth / (d.focal_px * d.distance_mm * s);
  place.sigma_mm = place.across_mm_px * d.noise_px;
  return place;
}

}  // namespace

DesignAnswer design_sensor(const SensorDesign& design) {
  check(design);
  const double edge = design.across_px / 2.0 / design.focal_px;
  DesignAnswer answer;
  answer.near = place_at(design, height_at(design, edge));
  answer.middle = place_at(design, 0);
  answer.far = place_at(design, height_at(design, -edge));
  answer.range_mm = answer.near.height_mm - answer.far.height_mm;
  return answer;
}

Rig rig_of_design(const SensorDesign& design) {
  check(design);
  const double s = std::sin(radians(design.angle_deg)), c = std::cos(radians(design.angle_deg));
  Sensor sensor;
  sensor.name = "design";
  sensor.camera.width = design.along_px, sensor.camera.height = design.across_px;
  sensor.camera.fx = sensor.camera.fy = design.focal_px;
  sensor.camera.cx = (design.along_px - 1) / 2.0, sensor.camera.cy = (design.across_px - 1) / 2.0;
  // Camera frame: x along the stripe. The plane holds x and the height's direction (0, s, -c): up in the
  // image is away from the camera.
  sensor.laser_planes.push_back({Eigen::Vector3d(0, c, s), s * design.distance_mm});
  Eigen::Matrix3d
      axes;  // columns: the camera's axes in the rig frame (x: normal, y: along the stripe, z: height)
  axes.col(0) = Eigen::Vector3d(0, 1, 0);
  axes.col(1) = Eigen::Vector3d(c, 0, s);
  axes.col(2) = Eigen::Vector3d(s, 0, -c);
  sensor.rig_from_camera.rotation = Eigen::Quaterniond(axes);
  Rig rig;
  rig.sensors.push_back(sensor);
  return rig;
}

}  // namespace lightstripe
