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

/// By hand: PCL's own header appends a camera or a range grid with some twenty properties and an empty face
/// element, which docs/interface.md does not have.
std::string ply_header(std::int64_t num_points) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment lightstripe, mm{}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\nproperty float intensity\n"
      "property int frame\nproperty int sensor\nproperty int line\nproperty float sigma\nend_header\n",
      slack(num_points, 1), num_points);
}

std::string pcd_header(std::int64_t num_points) {
  pcl::PCLPointCloud2 cloud;
  cloud.fields = pcl::getFields<CloudPoint>();
  cloud.width = static_cast<std::uint32_t>(num_points);
  cloud.height = 1;
  cloud.point_step = sizeof(CloudPoint);
  const std::string header =
      pcl::PCDWriter().generateHeaderBinary(cloud, Eigen::Vector4f::Zero(), Eigen::Quaternionf::Identity());
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

std::string cloud_header(CloudFormat format, std::int64_t num_points) {
  LIGHTSTRIPE_CHECK(num_points >= 0 && num_points <= kMaxCloudPoints, "a cloud's number of points");
  if (format == CloudFormat::kPly) return ply_header(num_points);
  if (format == CloudFormat::kPcd) return pcd_header(num_points);
  return {};
}

}  // namespace lightstripe
