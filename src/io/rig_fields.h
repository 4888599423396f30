// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// rig.yaml as it is written: what is required is optional here, so that its absence can be named.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/rig.h"
#include "io/yaml_fields.h"

namespace lightstripe {

inline constexpr const char* kRigFormat = "lightstripe-rig/1";

struct CameraFields {
  std::optional<double> fx, fy, cx, cy;
  std::optional<std::vector<double>> distortion;
};
template <class V>
void visit_fields(V&& v, CameraFields& o) {
  v("fx", o.fx);
  v("fy", o.fy);
  v("cx", o.cx);
  v("cy", o.cy);
  v("distortion", o.distortion);
}

struct PlaneFields {
  std::optional<Eigen::Vector3d> normal;
  std::optional<double> offset;
};
template <class V>
void visit_fields(V&& v, PlaneFields& o) {
  v("normal", o.normal);
  v("offset", o.offset);
}

struct TransformFields {
  std::optional<std::array<double, 4>> rotation;  ///< w x y z
  std::optional<Eigen::Vector3d> translation;
};
template <class V>
void visit_fields(V&& v, TransformFields& o) {
  v("rotation", o.rotation);
  v("translation", o.translation);
}

struct RigSensorFields {
  std::optional<std::string> name;
  std::optional<std::array<int, 2>> image_size;
  std::optional<CameraFields> camera;
  std::vector<PlaneFields> laser_planes;
  std::optional<TransformFields> rig_from_camera;
  std::optional<std::array<double, 2>> depth_range;  ///< mm
};
template <class V>
void visit_fields(V&& v, RigSensorFields& o) {
  v("name", o.name);
  v("image_size", o.image_size);
  v("camera", o.camera);
  v("laser_planes", o.laser_planes);
  v("rig_from_camera", o.rig_from_camera);
  v("depth_range", o.depth_range);
}

struct RigMotionFields {
  std::optional<MotionType> type;
  std::optional<Eigen::Vector3d> direction, axis_point, axis_direction;
  Moves moves = Moves::kRig;
};
template <class V>
void visit_fields(V&& v, RigMotionFields& o) {
  v("type", o.type);
  v("direction", o.direction);
  v("axis_point", o.axis_point);
  v("axis_direction", o.axis_direction);
  v("moves", o.moves);
}

/// Known entries are taken where they are well-formed; all others are passed over, because other tools may
/// write what they know.
struct QualityFields {
  RigQuality quality;
};
void read_field(const detail::YamlNode& node, QualityFields& fields, const detail::YamlPlace& place);
void write_field(detail::YamlNode& node, const QualityFields& fields);

struct RigFields {
  std::optional<std::string> format;
  std::vector<RigSensorFields> sensors;
  std::optional<RigMotionFields> motion;
  std::optional<TransformFields> tool_from_rig;
  QualityFields quality;
};
template <class V>
void visit_fields(V&& v, RigFields& o) {
  v("format", o.format);
  v("sensors", o.sensors);
  v("motion", o.motion);
  v("tool_from_rig", o.tool_from_rig);
  v("quality", o.quality);
}

}  // namespace lightstripe
