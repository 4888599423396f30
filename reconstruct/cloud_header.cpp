// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"

namespace lightstripe {
namespace {

constexpr std::size_t kMaxDigits = 10;  // of kMaxCloudPoints

std::string slack(std::int64_t num_points, std::size_t occurrences) {
  return std::string(occurrences * (kMaxDigits - fmt::format("{}", num_points).size()), ' ');
}

/// One line that people and programs read; CloudCompare's "global shift" is the same with other signs.
std::string origin_comment(const CloudOrigin& origin) {
  if (origin.isZero()) return "";
  return fmt::format("comment origin {} {} {} (add it to x y z; as CloudCompare's global shift: {} {} {})\n",
                     origin.x(), origin.y(), origin.z(), -origin.x(), -origin.y(), -origin.z());
}

/// By hand, as the one of .pcd: PCL's own appends a camera or a range grid with some twenty properties and an
/// empty face element, which docs/interface.md does not have; and a program that links PCL loads VTK and
/// OpenNI for these few lines. The tests read both with PCL.
std::string ply_header(std::int64_t num_points, const CloudOrigin& origin) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment lightstripe, mm{}\n{}element vertex {}\n"
      "property float x\nproperty float y\nproperty float z\nproperty float intensity\n"
      "property int frame\nproperty int sensor\nproperty int line\nproperty float sigma\nend_header\n",
      slack(num_points, 1), origin_comment(origin), num_points);
}

/// The viewpoint carries the origin in full precision, which PCL's 32-bit numbers would not.
std::string pcd_header(std::int64_t num_points, const CloudOrigin& origin) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
      "FIELDS x y z intensity frame sensor line sigma\nSIZE 4 4 4 4 4 4 4 4\nTYPE F F F F I I I F\n"
      "COUNT 1 1 1 1 1 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT {2} {3} {4} 1 0 0 0\nPOINTS {0}\n"
      "# lightstripe, mm{1}\nDATA binary\n",
      num_points, slack(num_points, 2), origin.x(), origin.y(), origin.z());  // WIDTH and POINTS
}

}  // namespace

CloudFormat cloud_format(const std::filesystem::path& path, const std::string& name) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".ply") return CloudFormat::kPly;
  if (extension == ".pcd") return CloudFormat::kPcd;
  if (extension == ".xyz") return CloudFormat::kXyz;
  throw Error(name, fmt::format("'{}' is no format for a point cloud", extension),
              "name it .ply, .pcd or .xyz");
}

std::string cloud_header(CloudFormat format, std::int64_t num_points, const CloudOrigin& origin) {
  LIGHTSTRIPE_CHECK(num_points >= 0 && num_points <= kMaxCloudPoints, "a cloud's number of points");
  if (format == CloudFormat::kPly) return ply_header(num_points, origin);
  if (format == CloudFormat::kPcd) return pcd_header(num_points, origin);
  return {};
}

}  // namespace lightstripe
