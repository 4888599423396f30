// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/triangulate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "reconstruct/laser_lines.h"
#include "reconstruct/sheet_middle.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where one pixel changes the range by more than this part of it, ray and plane run so nearly side by side
/// that the point says nothing: what is seen there is not the laser's light on a surface within reach.
constexpr double kMaxRangeChangePerPx = 0.05;

struct PlanePoint {
  Vector3d p_cam;        ///< mm
  double mm_per_px = 0;  ///< square to the section, per px across the stripe
};

/// A ray r = (x, y, 1) that meets the plane n.P = d in P = s r, with s = P.z.
struct MetRay {
  const Plane& plane;
  const Vector3d& ray;
  Eigen::Matrix2d normalised_per_px;

  Vector3d ray_change(const Vector2d& pixels) const {
    const Vector2d dxy = normalised_per_px * pixels;
    return {dxy.x(), dxy.y(), 0};
  }
  /// ds / s
  double range_change(const Vector3d& dr) const { return -plane.normal.dot(dr) / plane.normal.dot(ray); }
  /// dP / s
  Vector3d point_change(const Vector2d& pixels) const {
    const Vector3d dr = ray_change(pixels);
    return dr + ray * range_change(dr);
  }
};

/// How far the point on the laser plane moves square to the section when the stripe point moves by 1 px
/// across the stripe.
double section_mm_per_px(const MetRay& met, double depth_mm, const Vector2d& normal_px) {
  const Vector3d across = met.point_change(normal_px);
  const Vector3d along = met.point_change({-normal_px.y(), normal_px.x()});
  return depth_mm * across.cross(along).norm() / along.norm();
}

std::optional<PlanePoint> meet_plane(const Camera& camera, const Plane& plane, const StripePoint& point) {
  const auto ray = unproject(camera, {point.x, point.y});
  if (!ray) return std::nullopt;
  const auto p_cam = intersect(plane, Vector3d::Zero(), *ray);
  if (!p_cam) return std::nullopt;
  const MetRay met{plane, *ray, projection_jacobian(camera, ray->head<2>()).inverse()};
  const Vector2d normal_px(point.normal_x, point.normal_y);
  if (std::abs(met.range_change(met.ray_change(normal_px))) > kMaxRangeChangePerPx) return std::nullopt;
  return PlanePoint{*p_cam, section_mm_per_px(met, p_cam->z(), normal_px)};
}

/// Section coordinates of a point given in the rig frame and in the result's.
Vector2d section_coordinates(const Motion& motion, const FramePosition& position, const Vector3d& p_rig,
                             const Vector3d& p_result) {
  if (position.world_from_rig) return p_rig.tail<2>();
  if (motion.type != MotionType::kRotary) return p_result.tail<2>();
  const Vector3d from_axis = p_rig - motion.axis_point;  // the turn about the axis changes neither u nor v
  const double u = from_axis.dot(motion.axis_direction);
  return {u, (from_axis - u * motion.axis_direction).norm()};
}

/// What is the same for all points of one sensor in one frame.
struct FrameGeometry {
  const Rig& rig;
  const FramePosition& position;
  const Sensor& sensor;
  Matrix3d R_rig_from_camera;
  Rigid3 result_from_rig;
};

ProfilePoint profile_point(const FrameGeometry& geometry, const PlanePoint& met, const StripePoint& seen) {
  const Vector3d p_rig = geometry.R_rig_from_camera * met.p_cam + geometry.sensor.rig_from_camera.translation;
  ProfilePoint out;
  out.position = geometry.result_from_rig * p_rig;
  const Vector2d uv = section_coordinates(geometry.rig.motion, geometry.position, p_rig, out.position);
  out.u = uv.x();
  out.v = uv.y();
  out.sigma_mm = std::hypot(met.mm_per_px * seen.sigma_px, geometry.rig.quality.section_shape_sigma_mm);
  out.intensity = seen.intensity;
  return out;
}

void count_missed(int sensor, std::size_t points, const LineDecision& decision, Profile& profile) {
  profile.num_missed += static_cast<int>(points);
  if (!decision.may_lie_outside) return;
  OutsideRange here{sensor, static_cast<std::int64_t>(points), 0, 0};
  if (decision.outside_mm) here.nearest_mm = decision.outside_mm->front();
  if (decision.outside_mm) here.farthest_mm = decision.outside_mm->back();
  add_outside_range(here, profile.outside);
}

}  // namespace

void add_outside_range(const OutsideRange& more, std::vector<OutsideRange>& all) {
  auto same = std::find_if(all.begin(), all.end(), [&](const auto& o) { return o.sensor == more.sensor; });
  if (same == all.end()) same = all.insert(all.end(), {more.sensor, 0, 0, 0});
  same->points += more.points;
  if (more.farthest_mm <= 0) return;
  same->nearest_mm = same->farthest_mm > 0 ? std::min(same->nearest_mm, more.nearest_mm) : more.nearest_mm;
  same->farthest_mm = std::max(same->farthest_mm, more.farthest_mm);
}

Rigid3 result_from_rig(const Motion& motion, const FramePosition& position) {
  if (position.world_from_rig) return *position.world_from_rig;
  const double sign = sign_of(motion.moves);
  Rigid3 out;
  if (motion.type == MotionType::kRotary) {
    const double angle = sign * position.travel * std::numbers::pi / 180.0;
    out.rotation = Eigen::AngleAxisd(angle, motion.axis_direction);
    out.translation = motion.axis_point - out.rotation * motion.axis_point;
  } else {
    out.translation = sign * position.travel * motion.direction;
  }
  return out;
}

void triangulate_stripes(const std::vector<Stripe>& stripes, const Rig& rig, int sensor,
                         const FramePosition& position, Profile& profile) {
  LIGHTSTRIPE_CHECK(sensor >= 0 && sensor < static_cast<int>(rig.sensors.size()),
                    "no such sensor in the rig");
  const Sensor& of = rig.sensors[static_cast<std::size_t>(sensor)];
  const FrameGeometry geometry{rig, position, of, of.rig_from_camera.rotation.toRotationMatrix(),
                               result_from_rig(rig.motion, position)};
  const auto decisions = decide_laser_planes(stripes, of);
  std::vector<SheetShift> shifts;
  for (std::size_t line = 0; line < stripes.size(); ++line) {
    const auto& points = stripes[line].points;
    if (!decisions[line].plane) {
      count_missed(sensor, points.size(), decisions[line], profile);
      continue;
    }
    const Plane& plane = of.laser_planes[static_cast<std::size_t>(*decisions[line].plane)];
    find_sheet_shifts(of.camera, plane, points, shifts);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const StripePoint seen = in_sheet_middle(points[i], shifts[i]);
      const auto met = meet_plane(of.camera, plane, seen);
      if (!met) {
        ++profile.num_missed;
        continue;
      }
      ProfilePoint& point = profile.points.emplace_back(profile_point(geometry, *met, seen));
      point.sensor = sensor;
      point.line = static_cast<int>(line);
    }
  }
}

}  // namespace lightstripe
