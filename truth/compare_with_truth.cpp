// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/compare_with_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/polyline_search.h"
#include "core/transform.h"
#include "io/csv_reader.h"
#include "io/rig_file.h"
#include "pipeline/measurement_table.h"
#include "truth/section_alignment.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFarMm = 1.0;  // a point farther off than this is wrong, not inaccurate
constexpr double kSearchMm = 5.0;

double angle_deg(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

SensorError compare_sensors(const Sensor& sensor, const Sensor& truth) {
  const Plane& plane = sensor.laser_planes.at(0);
  const Plane& true_plane = truth.laser_planes.at(0);
  // Where the optical axis meets the true plane: the middle of what the sensor measures.
  const Vector3d middle = intersect(true_plane, Vector3d::Zero(), Vector3d::UnitZ())
                              .value_or(true_plane.normal * true_plane.offset);
  SensorError error;
  error.name = sensor.name;
  error.plane_angle_deg = angle_deg(plane.normal, true_plane.normal);
  error.plane_offset_mm = std::abs(plane.signed_distance(middle));
  error.focal_relative = std::abs(sensor.camera.fx / truth.camera.fx - 1);
  return error;
}

using Polylines = std::map<std::int64_t, std::vector<Vector2d>>;

Polylines read_sections(const fs::path& file) {
  Polylines sections;
  CsvReader rows(file, {"frame", "u", "v"});
  while (rows.next()) sections[rows.integer(0)].push_back({rows.number(1), rows.number(2)});
  return sections;
}

/// A bare set of places with a fast question: is there one within `reach` of here?
class PlaceIndex {
 public:
  explicit PlaceIndex(double reach) : reach_(reach) {}
  void insert(const Vector3d& p) { cells_[key(p, {0, 0, 0})].push_back(p); }
  bool near(const Vector3d& p) const {
    for (int i = 0; i < 27; ++i) {
      const auto cell = cells_.find(key(p, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}));
      if (cell == cells_.end()) continue;
      for (const auto& other : cell->second)
        if ((other - p).squaredNorm() <= reach_ * reach_) return true;
    }
    return false;
  }

 private:
  std::array<long, 3> key(const Vector3d& p, const Eigen::Vector3i& shift) const {
    const auto cell = [&](int axis) { return std::lround(std::floor(p[axis] / reach_)) + shift[axis]; };
    return {cell(0), cell(1), cell(2)};
  }
  double reach_;
  std::map<std::array<long, 3>, std::vector<Vector3d>> cells_;
};

/// The part of the true stripe points (blobs' places apart) with a measured point of their sensor and frame
/// near by.
double recovered(const std::vector<Profile>& profiles, const Rig& rig, const fs::path& stripes) {
  std::map<std::pair<std::int64_t, int>, PlaceIndex> measured;
  for (const auto& profile : profiles)
    for (const auto& point : profile.points)
      measured.try_emplace({profile.frame, point.sensor}, 1.5 * kFarMm).first->second.insert(point.position);
  std::map<std::string, int> sensor_index;
  for (const auto& sensor : rig.sensors)
    sensor_index.emplace(sensor.name, static_cast<int>(sensor_index.size()));
  long visible = 0, found = 0;
  CsvReader rows(stripes, {"frame", "sensor", "X", "Y", "Z", "blob"});
  while (rows.next()) {
    if (rows.integer(0) < 0 || rows.integer(5) != 0) continue;  // frame -1: a calibration image
    const auto index = measured.find({rows.integer(0), sensor_index.at(rows.text(1))});
    ++visible;
    if (index != measured.end() && index->second.near({rows.number(2), rows.number(3), rows.number(4)}))
      ++found;
  }
  return visible > 0 ? static_cast<double>(found) / static_cast<double>(visible) : 0.0;
}

struct SquareSum {
  double sum = 0;
  long count = 0;
  void add(double rms, long n) {
    sum += rms * rms * static_cast<double>(n);
    count += n;
  }
  double rms() const { return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0; }
};

/// The direction of travel or of the axis, rig frame.
Vector3d motion_direction(const Motion& motion) {
  return motion.type == MotionType::kRotary ? motion.axis_direction : Vector3d::UnitX();
}

/// The true axis passes nearest to the rig in its own axis_point: how far is the found one from there?
double axis_distance(const Rig& rig, const Rig& truth) {
  const Rigid3 from_truth = rig.sensors[0].rig_from_camera * truth.sensors[0].rig_from_camera.inverse();
  const Vector3d offset = from_truth * truth.motion.axis_point - rig.motion.axis_point;
  return (offset - offset.dot(rig.motion.axis_direction) * rig.motion.axis_direction).norm();
}

/// u counts from the axis' point in the rig file, which may be any: how much more it is in the truth's.
double shift_of_u(const Rig& rig, const Rig& truth) {
  if (rig.motion.type != MotionType::kRotary || truth.motion.type != MotionType::kRotary) return 0;
  return truth.motion.axis_direction.dot(rig.motion.axis_point - truth.motion.axis_point);
}

}  // namespace

RigError compare_rigs(const Rig& rig, const Rig& truth) {
  LIGHTSTRIPE_CHECK(rig.sensors.size() == truth.sensors.size(), "the rigs must have the same sensors");
  RigError error;
  const Rigid3 first = rig.sensors[0].rig_from_camera, true_first = truth.sensors[0].rig_from_camera;
  for (std::size_t i = 0; i < rig.sensors.size(); ++i) {
    error.sensors.push_back(compare_sensors(rig.sensors[i], truth.sensors[i]));
    const Rigid3 seen = first.inverse() * rig.sensors[i].rig_from_camera;
    const Rigid3 true_seen = true_first.inverse() * truth.sensors[i].rig_from_camera;
    error.baseline_mm = std::max(error.baseline_mm, (seen.translation - true_seen.translation).norm());
    error.baseline_deg = std::max(error.baseline_deg,
                                  rotation_angle(seen.rotation.conjugate() * true_seen.rotation) / kDegree);
  }
  error.travel_deg = angle_deg(first.rotation.conjugate() * motion_direction(rig.motion),
                               true_first.rotation.conjugate() * motion_direction(truth.motion));
  if (truth.motion.type == MotionType::kRotary) error.axis_mm = axis_distance(rig, truth);
  return error;
}

CloudError compare_cloud(const std::vector<Profile>& profiles, const Rig& rig, const fs::path& truth) {
  const Polylines sections = read_sections(truth / "sections.csv");
  const double shift = shift_of_u(rig, read_rig(truth / "rig.yaml"));
  CloudError error;
  SquareSum shape, absolute;
  double far = 0;
  for (const auto& profile : profiles) {
    const auto section = sections.find(profile.frame);
    if (section == sections.end() || profile.points.size() < 3) continue;
    std::vector<Vector2d> measured;
    for (const auto& point : profile.points) measured.push_back({point.u + shift, point.v});
    const SectionAlignment alignment =
        align_section(measured, section->second, {.search_mm = kSearchMm, .far_mm = kFarMm});
    shape.add(alignment.rms_mm, alignment.num_points);
    far += alignment.far_fraction * static_cast<double>(measured.size());
    error.points += static_cast<long>(measured.size());
    const PolylineSearch search(section->second, kSearchMm);
    for (const auto& p : measured)
      if (const auto foot = search.nearest(p)) absolute.add(foot->signed_distance, 1);
  }
  error.shape_rms_mm = shape.rms();
  error.absolute_rms_mm = absolute.rms();
  error.far_fraction = error.points > 0 ? far / static_cast<double>(error.points) : 0.0;
  error.recovered_fraction = recovered(profiles, rig, truth / "stripes.csv");
  return error;
}

std::vector<QuantityError> compare_wear(const std::vector<MeasuredFrame>& rows, ObjectKind kind,
                                        const fs::path& truth) {
  std::vector<std::string_view> names{"vertical_wear", "side_wear"};
  if (kind == ObjectKind::kWheel) names = {"flange_height", "flange_thickness", "qr", "diameter"};
  std::map<std::int64_t, const MeasuredFrame*> measured;
  for (const MeasuredFrame& row : rows) measured[row.frame] = &row;
  std::vector<QuantityError> errors;
  for (const std::string_view name : names) {
    QuantityError error{std::string(name), 0, 0, 0, 0};
    CsvReader csv(truth / "wear.csv", {"frame", name});
    while (csv.next()) {
      const auto row = measured.find(csv.integer(0));
      const Estimate* const estimate =
          row == measured.end() ? nullptr : find_estimate(*row->second, error.name);
      if (!estimate || !estimate->value) continue;
      const double difference = *estimate->value - csv.number(1);
      error.rms_mm += difference * difference, error.mean_mm += difference, ++error.frames;
      error.worst_mm = std::max(error.worst_mm, std::abs(difference));
    }
    if (error.frames == 0) continue;
    error.rms_mm = std::sqrt(error.rms_mm / error.frames), error.mean_mm /= error.frames;
    errors.push_back(error);
  }
  return errors;
}

}  // namespace lightstripe
