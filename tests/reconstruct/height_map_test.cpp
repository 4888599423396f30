// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/height_map.h"

#include <gtest/gtest.h>

#include <numbers>

#include "../io/temp_folder.h"
#include "cloud_files.h"
#include "core/error.h"

namespace lightstripe {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<Profile> scan_of(const std::function<double(double, double)>& surface, int frames = 30,
                             double step = 0.7) {
  std::vector<Profile> profiles;
  for (int k = 0; k < frames; ++k) profiles.push_back(stripe_over(k, k * step, surface));
  return profiles;
}

struct Pixel {
  double x, y, z;
};

std::vector<Pixel> pixels(const HeightMap& map) {
  std::vector<Pixel> out;
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column)
      out.push_back({map.column_first + column * map.column_step, map.row_first + row * map.row_step,
                     map.heights[static_cast<std::size_t>(row * map.width + column)]});
  return out;
}

HeightMap map_of(const std::vector<Profile>& profiles, const HeightMapOptions& options,
                 const Motion& motion = {}) {
  const TempFolder folder;
  write_cloud(folder.path() / "cloud.ply", profiles);
  return make_height_map(folder.path() / "cloud.ply", motion, options);
}

// A plane is linear along the stripe and along the travel: every pixel has its exact height, none is missing.
TEST(HeightMap, APlaneIsExactAtEveryPixelWhateverTheRaster) {
  const auto plane = [](double x, double y) { return 3 + 0.2 * x - 0.1 * y; };
  for (const double raster : {0.1, 0.35, 1.0, 2.3}) {
    const HeightMap map = map_of(scan_of(plane), {.raster_mm = raster});
    int missing = 0;
    for (const Pixel& p : pixels(map)) {
      if (std::isnan(p.z)) {
        ++missing;
        continue;
      }
      EXPECT_NEAR(p.z, plane(p.x, p.y),
                  0.2 * raster / 2 + 1e-5);  // beyond the last stripe: half a pixel's slope
    }
    EXPECT_LE(missing, map.height + map.width) << raster;  // the border beyond the last point
    for (const Pixel& p : pixels(map))
      if (p.x < 20 && p.y > -20 && p.y < 19.8) {
        EXPECT_NEAR(p.z, plane(p.x, p.y), 1e-5) << raster;
      }
  }
}

TEST(HeightMap, StepsKeepTheirHeightAndTheirPlace) {
  const auto stairs = [](double, double y) { return 10 * std::floor((y + 20) / 10); };
  const HeightMap map = map_of(scan_of(stairs), {.raster_mm = 0.5});
  for (const Pixel& p : pixels(map)) {
    const double to_edge = std::abs(std::remainder(p.y, 10.0));
    if (p.y < 19.8 && to_edge > 0.2 && !std::isnan(p.z)) {
      EXPECT_NEAR(p.z, stairs(0, p.y), 1e-5) << p.y;
    }
  }
}

TEST(HeightMap, AnEdgeAcrossTheTravelStaysAnEdge) {
  const auto edge = [](double x, double) { return x < 10 ? 0.0 : 7.0; };
  for (const Pixel& p : pixels(map_of(scan_of(edge), {.raster_mm = 0.1})))
    if (!std::isnan(p.z)) {
      EXPECT_TRUE(std::abs(p.z) < 1e-6 || std::abs(p.z - 7) < 1e-6) << p.x << " " << p.z;
    }
}

TEST(HeightMap, GapsStayUnlessTheyAreToBeBridged) {
  const auto hole = [](double, double y) { return y > 2 && y < 6 ? kNaN : y; };
  const auto in_hole = [](const HeightMap& map) {
    int known = 0;
    for (const Pixel& p : pixels(map)) known += p.y > 2.2 && p.y < 5.8 && !std::isnan(p.z) ? 1 : 0;
    return known;
  };
  EXPECT_EQ(in_hole(map_of(scan_of(hole), {.raster_mm = 0.5})), 0);
  // Bridged only within a stripe: what goes on as another line is not.
  EXPECT_EQ(in_hole(map_of(scan_of(hole), {.raster_mm = 0.5, .bridge_mm = 10})), 0);
  std::vector<Profile> one_line = scan_of(hole);
  for (Profile& profile : one_line)
    for (ProfilePoint& p : profile.points) p.line = 0;
  EXPECT_EQ(in_hole(map_of(one_line, {.raster_mm = 0.5})), 0);
  const HeightMap bridged = map_of(one_line, {.raster_mm = 0.5, .bridge_mm = 10});
  EXPECT_GT(in_hole(bridged), 100);
  for (const Pixel& p : pixels(bridged))
    if (p.x < 20 && p.y < 19.8) {
      EXPECT_NEAR(p.z, p.y, 1e-4);
    }
}

TEST(HeightMap, AMissingFrameLeavesAHole) {
  std::vector<Profile> profiles = scan_of([](double, double) { return 1.0; });
  profiles.erase(profiles.begin() + 10, profiles.begin() + 14);  // x from 7.0 to 9.1
  int known = 0, around = 0;
  for (const Pixel& p : pixels(map_of(profiles, {.raster_mm = 0.2}))) {
    known += p.x > 6.6 && p.x < 9.6 && !std::isnan(p.z) ? 1 : 0;
    around += p.x > 3.6 && p.x < 6.2 && !std::isnan(p.z) ? 1 : 0;
  }
  EXPECT_EQ(known, 0);
  EXPECT_GT(around, 1000);
}

TEST(HeightMap, OfTwoSurfacesTheUpperCountsAndTwoSensorsAreAveraged) {
  std::vector<Profile> profiles;
  for (int k = 0; k < 10; ++k) {
    Profile a = stripe_over(
        k, k, [](double, double) { return 5.0; }, 0);
    const Profile b = stripe_over(
        k, k, [](double, double y) { return y > 0 ? 5.1 : 2.0; }, 1);
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    profiles.push_back(a);
  }
  for (const Pixel& p : pixels(map_of(profiles, {.raster_mm = 0.5}))) {
    if (p.y < -0.2) {
      EXPECT_NEAR(p.z, 5.0, 1e-5);
    }
    if (p.y > 0.4 && p.y < 19.8) {
      EXPECT_NEAR(p.z, 5.05, 1e-5);
    }
  }
}

TEST(HeightMap, ARotaryScanBecomesRadiusByAngle) {
  Motion motion;
  motion.type = MotionType::kRotary;
  motion.axis_point = {0, 0, -50};
  std::vector<Profile> profiles;
  for (int k = 0; k < 120; ++k) {
    Profile profile = stripe_over(k, 0, [](double, double y) { return 30 + 0.1 * y; });
    const Eigen::AngleAxisd turn(k * 3 * std::numbers::pi / 180, motion.axis_direction);
    for (ProfilePoint& p : profile.points)
      p.position = motion.axis_point + turn * (p.position - motion.axis_point);
    profiles.push_back(profile);
  }
  const HeightMap map = map_of(profiles, {.raster_mm = 1}, motion);
  EXPECT_TRUE(map.rotary);
  EXPECT_NEAR(map.column_step * map.width, 360, 1e-9);
  int known = 0;
  for (const Pixel& p : pixels(map)) {
    if (std::isnan(p.z)) continue;
    ++known;
    EXPECT_NEAR(p.z, 80 + 0.1 * p.y, 0.002);
  }
  EXPECT_GT(known, map.width * (map.height - 2));  // a whole turn, across 360 degrees as well
}

TEST(HeightMap, AMapTooLargeIsRefused) {
  EXPECT_THROW(map_of(scan_of([](double, double) { return 0.0; }), {.raster_mm = 1e-4}), Error);
}

}  // namespace
}  // namespace lightstripe
