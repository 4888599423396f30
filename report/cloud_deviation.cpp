// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/cloud_deviation.h"

#include <cmath>
#include <limits>

namespace lightstripe {

Profile profile_of_frame(const std::vector<CloudPoint>& points, const Motion& motion) {
  Profile profile;
  if (!points.empty()) profile.frame = points.front().frame;
  for (const CloudPoint& p : points) {
    ProfilePoint out;
    out.position = {p.x, p.y, p.z};
    out.u = p.y, out.v = p.z;
    if (motion.type == MotionType::kRotary) {
      const Eigen::Vector3d arm = out.position - motion.axis_point;
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

FrameDeviation deviation_from(const ReferenceShape& reference, const Motion& motion,
                              const RegistrationOptions& options) {
  SectionPrior prior;
  if (motion.type == MotionType::kRotary) prior.upright = prior.may_mirror = true;
  return [&reference, motion, options, prior](const std::vector<CloudPoint>& points) {
    const Profile profile = profile_of_frame(points, motion);
    return section_deviation(profile, register_section(section_of(profile), reference, prior, options),
                             reference);
  };
}

}  // namespace lightstripe
