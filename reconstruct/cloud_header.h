// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The headers of cloud files; shared by cloud.cpp, which writes them, and read_cloud.cpp, which checks them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lightstripe {

enum class CloudFormat { kPly, kPcd, kXyz };

/// By extension, in any case; an Error that names `name` for every other one.
CloudFormat cloud_format(const std::filesystem::path& path, const std::string& name);

/// PCL keeps counts as 32-bit integers.
inline constexpr std::int64_t kMaxCloudPoints = 2147483647;

/// The header of a file with this many points of type CloudPoint; as long for every number, so that it can be
/// corrected in place once the number is known (a comment takes up the slack). XYZ has none.
std::string cloud_header(CloudFormat format, std::int64_t num_points);

}  // namespace lightstripe
