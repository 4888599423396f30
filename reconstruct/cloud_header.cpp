// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud_header.h"

#include <fmt/format.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "reconstruct/cloud_point_type.h"

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

/// By hand: PCL's own header appends a camera or a range grid with some twenty properties and an empty face
/// element, which docs/interface.md does not have.
std::string ply_header(std::int64_t num_points, const CloudOrigin& origin) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment lightstripe, mm{}\n{}element vertex {}\n"
      "property float x\nproperty float y\nproperty float z\nproperty float intensity\n"
      "property int frame\nproperty int sensor\nproperty int line\nproperty float sigma\nend_header\n",
      slack(num_points, 1), origin_comment(origin), num_points);
}

std::string pcd_header(std::int64_t num_points, const CloudOrigin& origin) {
  pcl::PCLPointCloud2 cloud;
  cloud.fields = pcl::getFields<CloudPoint>();
  cloud.width = static_cast<std::uint32_t>(num_points);
  cloud.height = 1;
  cloud.point_step = sizeof(CloudPoint);
  std::string header =
      pcl::PCDWriter().generateHeaderBinary(cloud, Eigen::Vector4f::Zero(), Eigen::Quaternionf::Identity());
  if (!origin.isZero()) {  // by hand: PCL has 32-bit numbers there
    const std::size_t at = header.find("VIEWPOINT "), end = header.find('\n', at);
    header.replace(at, end - at,
                   fmt::format("VIEWPOINT {} {} {} 1 0 0 0", origin.x(), origin.y(), origin.z()));
  }
  return header +
         fmt::format("# lightstripe, mm{}\nDATA binary\n", slack(num_points, 2));  // WIDTH and POINTS
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
