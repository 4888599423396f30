// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Writing rig.yaml, and its quality section both ways.
#include "io/rig_fields.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/rig_file.h"
#include "io/yaml_binding.h"

namespace lightstripe {

template <class V>
void visit_fields(V&& v, SectionBends& o) {
  v("centre_mm", o.centre_mm);
  v("scale_mm", o.scale_mm);
  v("bends", o.bends);
}

template <class V>
void visit_fields(V&& v, SensorQuality& o) {
  v("name", o.name);
  v("board_rms_px", o.board_rms_px);
  v("stripe_rms_px", o.stripe_rms_px);
  v("board_views", o.board_views);
  v("stripe_views", o.stripe_views);
}

namespace {

/// The sigmas as a list, which keeps its order in files.
struct QualityLists {
  RigQuality& quality;
  std::vector<std::pair<std::string, double>> sigma;
};
template <class V>
void visit_fields(V&& v, QualityLists& o) {
  v("sensors", o.quality.sensors);
  v("section_shape_sigma_mm", o.quality.section_shape_sigma_mm);
  v("section_absolute_sigma_mm", o.quality.section_absolute_sigma_mm);
  v("section_bends", o.quality.section_bends);
  v("cross_validation_ratio", o.quality.cross_validation_ratio);
  v("weakest", o.quality.weakest);
  v("warnings", o.quality.warnings);
  v("sigma", o.sigma);
}

/// Takes what fits and leaves the rest as it was.
struct TolerantReader {
  const detail::YamlNode& node;
  const detail::YamlPlace& place;

  template <class T>
  void operator()(std::string_view name, T& field, std::string_view = {}) const {
    for (const detail::YamlNode& item : node.items) {
      if (item.key != name) continue;
      T value = field;
      try {
        detail::read_field(item, value, place);
        field = std::move(value);
      } catch (const Error&) {  // another tool's entry of the same name
      }
    }
  }
};

CameraFields camera_fields(const Camera& camera) {
  std::size_t terms = camera.distortion.size();
  while (terms > 0 && camera.distortion.at(terms - 1) == 0) --terms;
  constexpr std::array<std::size_t, 4> kCounts = {5, 8, 12, 14};
  terms = *std::lower_bound(kCounts.begin(), kCounts.end(), terms);
  const auto begin = camera.distortion.begin();
  return {camera.fx, camera.fy, camera.cx, camera.cy,
          std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(terms))};
}

TransformFields transform_fields(const Rigid3& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return {std::array<double, 4>{q.w(), q.x(), q.y(), q.z()}, pose.translation};
}

RigSensorFields sensor_fields(const Sensor& sensor) {
  RigSensorFields fields;
  fields.name = sensor.name;
  fields.image_size = {sensor.camera.width, sensor.camera.height};
  fields.camera = camera_fields(sensor.camera);
  for (const Plane& plane : sensor.laser_planes) fields.laser_planes.push_back({plane.normal, plane.offset});
  fields.rig_from_camera = transform_fields(sensor.rig_from_camera);
  if (sensor.depth_range_mm[1] > 0) fields.depth_range = sensor.depth_range_mm;
  return fields;
}

RigMotionFields motion_fields(const Motion& motion) {
  RigMotionFields fields;
  fields.type = motion.type;
  if (motion.type == MotionType::kLinear) {
    fields.direction = motion.direction;
  } else {
    fields.axis_point = motion.axis_point;
    fields.axis_direction = motion.axis_direction;
  }
  fields.moves = motion.moves;
  return fields;
}

}  // namespace

void read_field(const detail::YamlNode& node, QualityFields& fields, const detail::YamlPlace& place) {
  if (node.kind != detail::YamlNode::Kind::kMap) return;
  QualityLists lists{fields.quality, {}};
  visit_fields(TolerantReader{node, place}, lists);
  fields.quality.sigma.insert(lists.sigma.begin(), lists.sigma.end());
}

void write_field(detail::YamlNode& node, const QualityFields& fields) {
  RigQuality quality = fields.quality;
  QualityLists lists{quality, {}};
  // What could not be estimated is left out: YAML's .nan would not be read back.
  for (const auto& entry : quality.sigma)
    if (std::isfinite(entry.second)) lists.sigma.push_back(entry);
  detail::write_field(node, lists);
}

std::string rig_to_yaml(const Rig& rig) {
  RigFields fields;
  fields.format = kRigFormat;
  for (const Sensor& sensor : rig.sensors) fields.sensors.push_back(sensor_fields(sensor));
  if (rig.motion.type != MotionType::kNone) fields.motion = motion_fields(rig.motion);
  if (rig.tool_from_rig) fields.tool_from_rig = transform_fields(*rig.tool_from_rig);
  fields.quality.quality = rig.quality;
  return dump_yaml(fields);
}

}  // namespace lightstripe
