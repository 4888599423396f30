// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud_filter.h"

#include <fmt/format.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/uniform_sampling.h>

#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "core/error.h"

namespace lightstripe {
namespace {

/// PCL numbers voxels in 32 bits: larger clouds are done block by block. Its voxels begin at multiples of
/// their size, as the blocks do, so that no voxel is cut.
constexpr double kBlockVoxels = 1000;

pcl::PointCloud<pcl::PointXYZ>::Ptr places(const std::vector<CloudPoint>& points) {
  auto out = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  out->reserve(points.size());
  for (const CloudPoint& p : points) out->emplace_back(p.x, p.y, p.z);
  return out;
}

std::vector<CloudPoint> without(const std::vector<CloudPoint>& points, const std::vector<bool>& dropped) {
  std::vector<CloudPoint> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!dropped[i]) out.push_back(points[i]);
  return out;
}

std::vector<CloudPoint> without_outliers(const std::vector<CloudPoint>& points, const CloudFilter& filter) {
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> removal(true);
  removal.setInputCloud(places(points));
  removal.setMeanK(filter.neighbours);
  removal.setStddevMulThresh(filter.outlier_sigma);
  pcl::Indices kept;
  removal.filter(kept);
  std::vector<bool> dropped(points.size(), true);
  for (const auto index : kept) dropped[static_cast<std::size_t>(index)] = false;
  return without(points, dropped);
}

using Block = std::array<std::int64_t, 3>;

std::map<Block, pcl::Indices> blocks_of(const std::vector<CloudPoint>& points, double voxel_mm) {
  // In float, as PCL computes the voxel of a point.
  const float inverse = 1.0F / static_cast<float>(voxel_mm);
  const auto block = [&](float v) {
    return static_cast<std::int64_t>(std::floor(std::floor(static_cast<double>(v * inverse)) / kBlockVoxels));
  };
  std::map<Block, pcl::Indices> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    out[{block(points[i].x), block(points[i].y), block(points[i].z)}].push_back(static_cast<pcl::index_t>(i));
  return out;
}

std::vector<CloudPoint> thinned(const std::vector<CloudPoint>& points, double voxel_mm) {
  const auto cloud = places(points);
  std::vector<bool> dropped(points.size(), false);
  for (const auto& [block, indices] : blocks_of(points, voxel_mm)) {
    pcl::UniformSampling<pcl::PointXYZ> sampling(true);
    sampling.setInputCloud(cloud);
    sampling.setIndices(std::make_shared<pcl::Indices>(indices));
    sampling.setRadiusSearch(voxel_mm);
    pcl::PointCloud<pcl::PointXYZ> unused;
    sampling.filter(unused);
    for (const auto index : *sampling.getRemovedIndices()) dropped[static_cast<std::size_t>(index)] = true;
  }
  return without(points, dropped);
}

double number_of(const std::string& word, const std::string& text) {
  double value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size() || !(value > 0) ||
      !std::isfinite(value))
    throw Error("--filter", "'" + word + "' has no positive number", "write for example outliers,voxel=0.2");
  return value;
}

}  // namespace

CloudFilter parse_cloud_filter(const std::string& text) {
  CloudFilter filter;
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    if (name == "outliers") {
      filter.outliers = true;
      if (equals != std::string::npos) filter.outlier_sigma = number_of(word, word.substr(equals + 1));
    } else if (name == "voxel" && equals != std::string::npos) {
      filter.voxel_mm = number_of(word, word.substr(equals + 1));
    } else {
      throw Error("--filter", "'" + word + "' is no filter", "write for example outliers,voxel=0.2");
    }
    begin = end + 1;
  }
  return filter;
}

std::vector<CloudPoint> filter_cloud(std::vector<CloudPoint> points, const CloudFilter& filter) {
  if (filter.outliers && static_cast<int>(points.size()) > filter.neighbours)
    points = without_outliers(points, filter);
  if (filter.voxel_mm > 0) points = thinned(points, filter.voxel_mm);
  return points;
}

}  // namespace lightstripe
