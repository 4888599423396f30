// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/random.h"
#include "reconstruct/cloud_point_type.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CloudFile : public testing::Test {
 protected:
  CloudFile() : folder_(fs::temp_directory_path() / ("lightstripe_cloud_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~CloudFile() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / name; }

 private:
  fs::path folder_;
};

Profile random_profile(std::int64_t frame, int num_points) {
  Random random(99, static_cast<std::uint64_t>(frame));
  Profile profile;
  profile.frame = frame;
  for (int i = 0; i < num_points; ++i) {
    ProfilePoint p;
    p.position = {random.uniform(-500, 500), random.uniform(-100, 100), 1e-5 * random.gaussian()};
    p.sigma_mm = random.uniform(0, 0.1);
    p.intensity = static_cast<float>(random.uniform(0, 255));
    p.sensor = i % 2;
    p.line = i % 3;
    profile.points.push_back(p);
  }
  return profile;
}

std::vector<Profile> profiles_with(int num_profiles, int num_points) {
  std::vector<Profile> profiles;
  for (int i = 0; i < num_profiles; ++i) profiles.push_back(random_profile(i, num_points));
  return profiles;
}

std::int64_t write(const fs::path& path, const std::vector<Profile>& profiles) {
  CloudWriter writer(path);
  for (const Profile& profile : profiles) writer.append(profile);
  return writer.finish();
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

void expect_holds(const CloudPoint& found, const Profile& profile, const ProfilePoint& p) {
  EXPECT_EQ(found.x, static_cast<float>(p.position.x()));
  EXPECT_EQ(found.y, static_cast<float>(p.position.y()));
  EXPECT_EQ(found.z, static_cast<float>(p.position.z()));
  EXPECT_EQ(found.intensity, p.intensity);
  EXPECT_EQ(found.frame, profile.frame);
  EXPECT_EQ(found.sensor, p.sensor);
  EXPECT_EQ(found.line, p.line);
  EXPECT_EQ(found.sigma, static_cast<float>(p.sigma_mm));
}

template <class Points>
void expect_holds_all(const Points& found, const std::vector<Profile>& profiles) {
  std::size_t i = 0;
  for (const Profile& profile : profiles)
    for (const ProfilePoint& p : profile.points) {
      ASSERT_LT(i, found.size());
      expect_holds(found[i++], profile, p);
    }
  EXPECT_EQ(i, found.size());
}

// Reads as a script of a user would: header lines to `end_header`, then 32 bytes a vertex.
std::vector<CloudPoint> parse_ply_by_hand(const std::string& bytes, std::vector<std::string>& header) {
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  std::istringstream lines(bytes.substr(0, body));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("comment", 0) == 0) continue;
    header.push_back(line);
    if (line.rfind("element vertex ", 0) == 0) count = std::stoul(line.substr(15));
  }
  EXPECT_EQ(bytes.size(), body + 32 * count);
  std::vector<CloudPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + body + 32 * i;
    CloudPoint& p = points[i];
    std::memcpy(&p.x, at, 4), std::memcpy(&p.y, at + 4, 4), std::memcpy(&p.z, at + 8, 4);
    std::memcpy(&p.intensity, at + 12, 4), std::memcpy(&p.frame, at + 16, 4),
        std::memcpy(&p.sensor, at + 20, 4);
    std::memcpy(&p.line, at + 24, 4), std::memcpy(&p.sigma, at + 28, 4);
  }
  return points;
}

TEST_F(CloudFile, PlyHoldsTheContractsPropertiesToTheByte) {
  const auto profiles = profiles_with(13, 97);
  EXPECT_EQ(write(path("a.ply"), profiles), 13 * 97);
  std::vector<std::string> header;
  const auto points = parse_ply_by_hand(bytes_of(path("a.ply")), header);
  EXPECT_EQ(header,
            (std::vector<std::string>{"ply", "format binary_little_endian 1.0", "element vertex 1261",
                                      "property float x", "property float y", "property float z",
                                      "property float intensity", "property int frame", "property int sensor",
                                      "property int line", "property float sigma", "end_header"}));
  expect_holds_all(points, profiles);
}

TEST_F(CloudFile, PclReadsThePlyBack) {
  const auto profiles = profiles_with(5, 40);
  write(path("a.ply"), profiles);
  pcl::PointCloud<CloudPoint> cloud;
  ASSERT_GE(pcl::PLYReader().read(path("a.ply").string(), cloud), 0);
  EXPECT_EQ(cloud.width, 200u);
  EXPECT_EQ(cloud.height, 1u);
  expect_holds_all(cloud.points, profiles);
}

TEST_F(CloudFile, PclReadsThePcdBack) {
  const auto profiles = profiles_with(5, 40);
  EXPECT_EQ(write(path("a.pcd"), profiles), 200);
  pcl::PCLPointCloud2 fields;
  ASSERT_EQ(pcl::PCDReader().read(path("a.pcd").string(), fields), 0);
  ASSERT_EQ(fields.fields.size(), 8u);
  EXPECT_EQ(fields.fields[4].name, "frame");
  EXPECT_EQ(fields.fields[4].datatype, pcl::PCLPointField::INT32);
  pcl::PointCloud<CloudPoint> cloud;
  pcl::fromPCLPointCloud2(fields, cloud);
  EXPECT_EQ(cloud.height, 1u);
  expect_holds_all(cloud.points, profiles);
}

TEST_F(CloudFile, XyzIsOneRowAPointWithTheSameBits) {
  const auto profiles = profiles_with(3, 20);
  EXPECT_EQ(write(path("a.xyz"), profiles), 60);
  std::istringstream text(bytes_of(path("a.xyz")));
  for (const Profile& profile : profiles)
    for (const ProfilePoint& p : profile.points) {
      std::string line;
      ASSERT_TRUE(std::getline(text, line));
      std::istringstream row(line);
      float x = 0, y = 0, z = 0;
      ASSERT_TRUE(row >> x >> y >> z) << line;
      EXPECT_TRUE((row >> std::ws).eof());
      EXPECT_EQ(x, static_cast<float>(p.position.x()));
      EXPECT_EQ(y, static_cast<float>(p.position.y()));
      EXPECT_EQ(z, static_cast<float>(p.position.z()));
    }
  EXPECT_EQ(text.peek(), EOF);
}

TEST_F(CloudFile, ReadCloudReturnsWhatWasWrittenForEveryLengthOfTheCount) {
  for (const std::string name : {"a.ply", "a.pcd", "A.PLY"}) {
    for (int num_points : {0, 1, 9, 10, 99, 100, 1234}) {
      const std::vector<Profile> profiles{Profile{}, random_profile(7, num_points)};
      EXPECT_EQ(write(path(name), profiles), num_points);
      expect_holds_all(read_cloud(path(name)), profiles);
    }
  }
}

TEST_F(CloudFile, HeaderIsAsLongForEveryCount) {
  for (const std::string extension : {".ply", ".pcd"}) {
    write(path("small" + extension), profiles_with(1, 1));
    write(path("large" + extension), profiles_with(10, 1000));
    EXPECT_EQ(fs::file_size(path("large" + extension)) - fs::file_size(path("small" + extension)),
              9999u * 32);
  }
}

TEST_F(CloudFile, UnknownExtensionAndUnwritablePathAreErrors) {
  EXPECT_THROW(CloudWriter(path("a.stl")), Error);
  EXPECT_THROW(CloudWriter(path("a")), Error);
  EXPECT_THROW(CloudWriter(path("no/such/folder.ply")), Error);
  try {
    CloudWriter(path("no/such/folder.ply"), "cloud.ply");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("cloud.ply: "));
  }
}

TEST_F(CloudFile, AFullDiskIsAnErrorAtTheLatestInFinish) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  for (const std::string name : {"full.ply", "full.xyz"}) {
    fs::create_symlink("/dev/full", path(name));
    EXPECT_THROW(write(path(name), profiles_with(1, 3)), Error);
    EXPECT_THROW(write(path(name), profiles_with(100, 300)), Error);
  }
}

TEST_F(CloudFile, AppendAfterFinishIsTheCallersFault) {
  CloudWriter writer(path("a.ply"));
  writer.finish();
  EXPECT_THROW(writer.append(Profile{}), std::logic_error);
  EXPECT_THROW(writer.finish(), std::logic_error);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_F(CloudFile, HostileHeadersAreRefusedBeforePclSeesThem) {
  write(path("good.ply"), profiles_with(2, 25));
  const std::string good = bytes_of(path("good.ply"));
  const std::vector<std::string> hostile{
      "",
      "ply\n",
      good.substr(0, 100),
      good.substr(0, good.size() - 1),
      good + "x",
      replaced(good, "element vertex 50", "element vertex 51"),
      replaced(good, "element vertex 50", "element vertex -1"),
      replaced(good, "element vertex 50", "element vertex 99999999999999999999"),
      replaced(good, "element vertex 50", "element vertex 2147483647"),
      replaced(good, "property float x", "property double x"),
      replaced(good, "property int line", "property list int int line"),
      replaced(good, "binary_little_endian", "ascii"),
      std::string(4096, '\0')};
  for (std::size_t i = 0; i < hostile.size(); ++i) {
    put(path("bad.ply"), hostile[i]);
    EXPECT_THROW(read_cloud(path("bad.ply")), Error) << "case " << i;
  }
}

TEST_F(CloudFile, HostilePcdHeadersAreRefusedToo) {
  write(path("good.pcd"), profiles_with(2, 25));
  const std::string good = bytes_of(path("good.pcd"));
  for (const std::string& bad :
       {good.substr(0, good.size() - 7), replaced(good, "WIDTH 50", "WIDTH 5000000"),
        replaced(good, "POINTS 50", "POINTS 4000000000"), replaced(good, "COUNT 1", "COUNT 9"),
        replaced(good, "DATA binary", "DATA binary_compressed")}) {
    put(path("bad.pcd"), bad);
    EXPECT_THROW(read_cloud(path("bad.pcd")), Error) << bad.substr(0, 300);
  }
}

// Found by fuzzing: a reader that looks for header lines in the points allocates what they say.
TEST_F(CloudFile, PointsThatLookLikeHeaderLinesArePoints) {
  for (const std::string name : {"a.ply", "a.pcd"}) {
    write(path(name), profiles_with(1, 4));
    std::string bytes = bytes_of(path(name));
    const std::string line = "\nPOINTS 66666666666666666\n";
    bytes.replace(bytes.size() - 4 * sizeof(CloudPoint), line.size(), line);
    put(path(name), bytes);
    EXPECT_EQ(read_cloud(path(name)).size(), 4u);
  }
}

TEST_F(CloudFile, ReadCloudNamesWhatItCannotRead) {
  EXPECT_THROW(read_cloud(path("missing.ply")), Error);
  EXPECT_THROW(read_cloud(path("a.obj")), Error);
  write(path("a.xyz"), profiles_with(1, 1));
  EXPECT_THROW(read_cloud(path("a.xyz")), Error);
}

}  // namespace
}  // namespace lightstripe
