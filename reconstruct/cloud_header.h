// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The two parts of a cloud file, header and points, for those who put files together themselves.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/profile.h"

namespace lightstripe {

enum class CloudFormat { kPly, kPcd, kXyz };

/// By extension, in any case; an Error that names `name` for every other one.
CloudFormat cloud_format(const std::filesystem::path& path, const std::string& name);

/// PCL keeps counts as 32-bit integers.
inline constexpr std::int64_t kMaxCloudPoints = 2147483647;

/// What is subtracted from every point before it becomes a 32-bit number, mm; 0 where that is not needed.
using CloudOrigin = Eigen::Vector3d;

/// The header of a file with this many points of type CloudPoint; as long for every number, so that it can be
/// corrected in place once the number is known (a comment takes up the slack). XYZ has none. An origin that
/// is not 0 stands in a comment of PLY ("comment origin X Y Z ...") and in PCD's VIEWPOINT.
std::string cloud_header(CloudFormat format, std::int64_t num_points,
                         const CloudOrigin& origin = CloudOrigin::Zero());

/// Appends the profile's points as they lie in a file of this format, in XYZ with their full coordinates.
/// Frames have to fit into 32 bits. An Error where a coordinate is not finite or beyond 32-bit numbers.
void append_cloud_points(std::string& bytes, CloudFormat format, const Profile& profile,
                         const CloudOrigin& origin = CloudOrigin::Zero());

struct CloudPart {
  CloudFormat format = CloudFormat::kPly;
  std::int64_t num_points = 0;
  std::uint64_t points_at = 0;                   ///< bytes before the first point
  std::int64_t first_frame = 0, last_frame = 0;  ///< of its points; 0 where there are none
  CloudOrigin origin = CloudOrigin::Zero();
};

/// Looks at a .ply or .pcd file that was written by lightstripe; an Error where its header is not of that
/// layout or counts other points than the file holds.
CloudPart inspect_cloud(const std::filesystem::path& path);

}  // namespace lightstripe
