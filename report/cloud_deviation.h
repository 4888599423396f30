// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How far the points of a cloud lie from a nominal outline: what the view colours as wear.
#pragma once

#include "core/profile.h"
#include "core/rig.h"
#include "measure/register_section.h"
#include "pipeline/measure_job.h"
#include "report/cloud_view.h"

namespace lightstripe {

/// The section of one frame of a cloud; u, v as in profiles.csv: y, z, or of a rotary motion the position
/// along the axis and the radius.
/// `origin`: what the points count from.
Profile profile_of_frame(const std::vector<CloudPoint>& points, const Motion& motion,
                         const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Signed distances (mm, + outside) of a section's points to the reference after `registration`, NaN where
/// the section is not registered, a point is out of the reference's reach or beyond the end of an open one.
std::vector<float> section_deviation(const Profile& profile, const Registration& registration,
                                     const ReferenceShape& reference);

/// Registers each frame on its own. `reference` has to outlive the result.
FrameDeviation deviation_from(const ReferenceShape& reference, const Motion& motion,
                              const Eigen::Vector3d& origin, const RegistrationOptions& options = {});

/// The sections of a measurement with their deviations, thinned as view_of_cloud() does. `page` is where the
/// view will be written; `scan_file` (may be empty) names the scan whose pictures are linked to.
CloudView view_of_sections(const MeasureJob& job, const MeasureResult& result,
                           const std::filesystem::path& page, const std::filesystem::path& scan_file,
                           std::int64_t max_points = kMaxViewPoints);

}  // namespace lightstripe
