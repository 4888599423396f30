// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/rig_file.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "io/rig_fields.h"
#include "io/sensor_name.h"
#include "io/yaml_binding.h"

namespace lightstripe {
namespace {

constexpr double kAxisTolerance = 1e-4;  // what a person or a tool that writes six digits leaves
constexpr int kMaxSide = 1 << 15;        // px

/// A place in the file, for complaints.
struct Place {
  std::string file, key;

  Place operator/(const std::string& part) const { return {file, key.empty() ? part : key + "." + part}; }
  void require(bool holds, const char* what_is_wrong, const char* what_to_do) const {
    if (!holds) throw Error(file + ": " + key, what_is_wrong, what_to_do);
  }
  template <class T>
  const T& given(const std::optional<T>& value) const {
    require(value.has_value(), "is missing", "complete the file, or make it anew by lightstripe calibrate");
    return *value;
  }
};

/// Divides by the length unless that is 1 already to the last bits, so that what was exact stays the same
/// bits.
template <class V>
V made_unit(const V& vector, const Place& place) {
  const double length = vector.norm();
  place.require(std::abs(length - 1) <= kAxisTolerance, "has not unit length", "scale it to length 1");
  return std::abs(length - 1) < 1e-15 ? vector : V(vector / length);
}

/// Beyond these no lens is, and no number of a point would be finite.
void check_lens_place(const Camera& camera, const Place& place) {
  const double widest = std::max(camera.width, camera.height);
  for (const auto& [key, value] : {std::pair{"fx", camera.fx}, std::pair{"fy", camera.fy}})
    (place / key)
        .require(value >= 0.01 * widest && value <= 1e6 * widest,
                 "is no focal length for pictures of this size", "give the focal length in px");
  for (const auto& [key, value] : {std::pair{"cx", camera.cx}, std::pair{"cy", camera.cy}})
    (place / key)
        .require(std::abs(value) <= 1e3 * widest, "is no principal point for pictures of this size",
                 "give the pixel where the optical axis meets the sensor");
}

Camera checked_camera(const CameraFields& fields, const std::array<int, 2>& size, const Place& place) {
  Camera camera;
  camera.width = size[0];
  camera.height = size[1];
  camera.fx = (place / "fx").given(fields.fx);
  camera.fy = (place / "fy").given(fields.fy);
  camera.cx = (place / "cx").given(fields.cx);
  camera.cy = (place / "cy").given(fields.cy);
  (place / "fx").require(camera.fx > 0, "is not positive", "give the focal length in px");
  (place / "fy").require(camera.fy > 0, "is not positive", "give the focal length in px");
  check_lens_place(camera, place);
  const std::vector<double>& terms = (place / "distortion").given(fields.distortion);
  constexpr std::array<std::size_t, 5> kCounts = {4, 5, 8, 12, 14};
  (place / "distortion")
      .require(std::find(kCounts.begin(), kCounts.end(), terms.size()) != kCounts.end(),
               "has a number of terms that no model has", "give 4, 5, 8, 12 or 14 terms in OpenCV's order");
  std::copy(terms.begin(), terms.end(), camera.distortion.begin());
  (place / "distortion")
      .require(invertible_over_image(camera),
               "folds over inside the image, so that a pixel has no single ray",
               "calibrate with fewer distortion terms or with boards up to the image's corners");
  return camera;
}

Plane checked_plane(const PlaneFields& fields, const Place& place) {
  const Eigen::Vector3d& normal = (place / "normal").given(fields.normal);
  const Eigen::Vector3d unit = made_unit(normal, place / "normal");
  const double offset = (place / "offset").given(fields.offset);
  (place / "offset")
      .require(offset > 0, "is not positive",
               "turn the signs of normal and offset (a plane through the camera has none)");
  // The same plane: both sides of n.X = d are divided by |n|.
  return {unit, unit == normal ? offset : offset / normal.norm()};
}

Rigid3 checked_transform(const TransformFields& fields, const Place& place) {
  const std::array<double, 4>& q = (place / "rotation").given(fields.rotation);
  const Eigen::Vector4d unit = made_unit(Eigen::Vector4d(q[0], q[1], q[2], q[3]), place / "rotation");
  return {Eigen::Quaterniond(unit[0], unit[1], unit[2], unit[3]),
          (place / "translation").given(fields.translation)};
}

Sensor checked_sensor(const RigSensorFields& fields, RigUse use, const Place& place) {
  Sensor sensor;
  sensor.name = (place / "name").given(fields.name);
  (place / "name").require(!sensor.name.empty(), "is empty", "give each sensor a name");
  check_sensor_name(sensor.name, place.file + ": " + (place / "name").key);
  const std::array<int, 2>& size = (place / "image_size").given(fields.image_size);
  (place / "image_size")
      .require(std::min(size[0], size[1]) > 0 && std::max(size[0], size[1]) <= kMaxSide, "is out of range",
               "give width and height in px");
  sensor.camera = checked_camera((place / "camera").given(fields.camera), size, place / "camera");
  (place / "laser_planes")
      .require(use == RigUse::kCameras || !fields.laser_planes.empty(), "is missing or empty",
               "list normal and offset of each; a camera calibrated with `laser: none` needs a session with "
               "the laser on");
  for (std::size_t i = 0; i < fields.laser_planes.size(); ++i)
    sensor.laser_planes.push_back(
        checked_plane(fields.laser_planes[i], place / ("laser_planes[" + std::to_string(i) + "]")));
  sensor.rig_from_camera =
      checked_transform((place / "rig_from_camera").given(fields.rig_from_camera), place / "rig_from_camera");
  if (fields.depth_range) {
    sensor.depth_range_mm = *fields.depth_range;
    (place / "depth_range")
        .require(sensor.depth_range_mm[0] >= 0 && sensor.depth_range_mm[1] > sensor.depth_range_mm[0],
                 "is no range", "give the nearest and the farthest depth in mm");
  }
  return sensor;
}

Motion checked_motion(const RigMotionFields& fields, const Place& place) {
  Motion motion;
  motion.type = (place / "type").given(fields.type);
  motion.moves = fields.moves;
  const bool linear = motion.type == MotionType::kLinear;
  place.require(linear ? !fields.axis_point && !fields.axis_direction : !fields.direction,
                "mixes the keys of linear and rotary motion",
                "linear: direction; rotary: axis_point, axis_direction");
  if (linear) {
    motion.direction = made_unit((place / "direction").given(fields.direction), place / "direction");
  } else {
    motion.axis_point = (place / "axis_point").given(fields.axis_point);
    motion.axis_direction =
        made_unit((place / "axis_direction").given(fields.axis_direction), place / "axis_direction");
  }
  return motion;
}

}  // namespace

Rig read_rig(const std::filesystem::path& path, RigUse use) {
  RigFields fields;
  read_yaml(path, fields);
  const Place place{path.string(), ""};
  (place / "format")
      .require((place / "format").given(fields.format) == kRigFormat, "is not lightstripe-rig/1",
               "use a rig.yaml of this version");
  (place / "sensors").require(!fields.sensors.empty(), "is missing or empty", "list at least one sensor");
  Rig rig;
  std::set<std::string> names;
  for (std::size_t i = 0; i < fields.sensors.size(); ++i) {
    const Place sensor = place / ("sensors[" + std::to_string(i) + "]");
    rig.sensors.push_back(checked_sensor(fields.sensors[i], use, sensor));
    (sensor / "name")
        .require(names.insert(rig.sensors.back().name).second, "is the name of an earlier sensor",
                 "give each its own name");
  }
  if (fields.motion) rig.motion = checked_motion(*fields.motion, place / "motion");
  if (fields.tool_from_rig)
    rig.tool_from_rig = checked_transform(*fields.tool_from_rig, place / "tool_from_rig");
  rig.quality = fields.quality.quality;
  return rig;
}

}  // namespace lightstripe
