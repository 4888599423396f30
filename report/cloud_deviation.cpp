// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/cloud_deviation.h"

#include <cmath>
#include <limits>

#include "io/session_file.h"

namespace lightstripe {
namespace {

CloudPoint cloud_point(std::int64_t frame, const ProfilePoint& p) {
  const Eigen::Vector3f at = p.position.cast<float>();
  return {at.x(),
          at.y(),
          at.z(),
          p.intensity,
          static_cast<std::int32_t>(frame),
          p.sensor,
          p.line,
          static_cast<float>(p.sigma_mm)};
}

}  // namespace

Profile profile_of_frame(const std::vector<CloudPoint>& points, const Motion& motion,
                         const Eigen::Vector3d& origin) {
  Profile profile;
  if (!points.empty()) profile.frame = points.front().frame;
  for (const CloudPoint& p : points) {
    ProfilePoint out;
    out.position = {p.x, p.y, p.z};
    out.u = p.y, out.v = p.z;
    if (motion.type == MotionType::kRotary) {
      const Eigen::Vector3d arm = out.position + origin - motion.axis_point;
      out.u = arm.dot(motion.axis_direction);
      out.v = (arm - out.u * motion.axis_direction).norm();
    }
    out.sigma_mm = p.sigma;
    out.intensity = p.intensity;
    out.sensor = p.sensor;
    out.line = p.line;
    profile.points.push_back(out);
  }
  return profile;
}

std::vector<float> section_deviation(const Profile& profile, const Registration& registration,
                                     const ReferenceShape& reference) {
  std::vector<float> out(profile.points.size(), std::numeric_limits<float>::quiet_NaN());
  if (!registration.usable()) return out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const ProfilePoint& p = profile.points[i];
    const auto foot = reference.nearest(registration.reference_from_section * Eigen::Vector2d(p.u, p.v));
    if (foot && !foot->beyond_end) out[i] = static_cast<float>(foot->signed_distance);
  }
  return out;
}

CloudView view_of_sections(const MeasureJob& job, const MeasureResult& result,
                           const std::filesystem::path& page, const std::filesystem::path& scan_file,
                           std::int64_t max_points) {
  CloudView view;
  view.title = job.profiles.filename().string();
  view.nominal = result.references.at(result.rows.front().travel).name();
  for (const Profile& profile : result.input.profiles)
    view.total += static_cast<std::int64_t>(profile.points.size());
  EvenThinning thinning(view.total, max_points);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const Profile& profile = result.input.profiles[i];
    const MeasuredFrame& row = result.rows[i];
    std::vector<float> deviation =
        section_deviation(profile, row.registration, result.references.at(row.travel));
    if (row.right_registration) {  // of two rails each point is near one of them
      const auto right = section_deviation(profile, *row.right_registration, result.references.right());
      for (std::size_t k = 0; k < right.size(); ++k)
        if (std::isnan(deviation[k])) deviation[k] = right[k];
    }
    for (std::size_t k = 0; k < profile.points.size(); ++k) {
      if (!thinning.keep()) continue;
      view.points.push_back(cloud_point(profile.frame, profile.points[k]));
      view.deviation_mm.push_back(deviation[k]);
    }
  }
  if (scan_file.empty()) return view;
  view.links = frame_links(scan_file.string(), job.rig.string(), page, frames_shown(view));
  for (const auto& [sensor, pattern] : read_scan(scan_file).frames) view.sensors.push_back(sensor);
  return view;
}

FrameDeviation deviation_from(const ReferenceShape& reference, const Motion& motion,
                              const Eigen::Vector3d& origin, const RegistrationOptions& options) {
  SectionPrior prior;
  if (motion.type == MotionType::kRotary) prior.upright = prior.may_mirror = true;
  return [&reference, motion, origin, options, prior](const std::vector<CloudPoint>& points) {
    const Profile profile = profile_of_frame(points, motion, origin);
    return section_deviation(profile, register_section(section_of(profile), reference, prior, options),
                             reference);
  };
}

}  // namespace lightstripe
