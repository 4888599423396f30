// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/random.h"

namespace lightstripe {
namespace {

std::vector<CloudPoint> sheet(int count, double length) {
  Random random(3);
  std::vector<CloudPoint> points;
  for (int i = 0; i < count; ++i) {
    CloudPoint p;
    p.x = static_cast<float>(random.uniform(0, length)), p.y = static_cast<float>(random.uniform(-30, 30));
    p.frame = i;
    points.push_back(p);
  }
  return points;
}

std::array<long, 3> voxel(const CloudPoint& p, float size) {
  const float inverse = 1 / size;
  return {std::lround(std::floor(p.x * inverse)), std::lround(std::floor(p.y * inverse)),
          std::lround(std::floor(p.z * inverse))};
}

TEST(CloudFilter, LonePointsGoAndTheRestStaysInOrder) {
  std::vector<CloudPoint> points = sheet(4000, 60);
  for (int i = 0; i < 5; ++i)
    points[static_cast<std::size_t>(700 * i + 5)].z = static_cast<float>(40 + 20 * i);
  const auto kept = filter_cloud(points, parse_cloud_filter("outliers"));
  EXPECT_GT(kept.size(), 3900U);
  for (const CloudPoint& p : kept) EXPECT_EQ(p.z, 0);
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_LT(kept[i - 1].frame, kept[i].frame);
}

// 30 m at 0.2 mm: more voxels than PCL can number in one piece.
TEST(CloudFilter, OnePointStaysInEachVoxelHoweverLongTheScan) {
  std::vector<CloudPoint> points = sheet(20000, 20);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i].x += 30000;
  points[7].z = 900;
  std::set<std::array<long, 3>> voxels;
  for (const CloudPoint& p : points) voxels.insert(voxel(p, 0.5F));
  const auto kept = filter_cloud(points, parse_cloud_filter("voxel=0.5"));
  EXPECT_EQ(kept.size(), voxels.size());
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_LT(kept[i - 1].frame, kept[i].frame);
}

TEST(CloudFilter, WordsAreReadStrictly) {
  const CloudFilter filter = parse_cloud_filter("outliers=2.5,voxel=0.2");
  EXPECT_TRUE(filter.outliers);
  EXPECT_EQ(filter.outlier_sigma, 2.5);
  EXPECT_EQ(filter.voxel_mm, 0.2);
  for (const char* const text :
       {"voxel", "voxel=", "voxel=-1", "voxel=x", "smooth", "outliers,,voxel=1", "voxel=inf"})
    EXPECT_THROW(parse_cloud_filter(text), Error) << text;
}

}  // namespace
}  // namespace lightstripe
