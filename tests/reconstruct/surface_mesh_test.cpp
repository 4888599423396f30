// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/surface_mesh.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "../io/temp_folder.h"
#include "cloud_files.h"
#include "core/error.h"
#include "core/random.h"
#include "reconstruct/manifold.h"

namespace lightstripe {
namespace {

Rig rig_above() {
  Rig rig;
  rig.sensors.resize(1);
  rig.sensors[0].rig_from_camera.translation = {-100, 0, 300};
  rig.motion.type = MotionType::kLinear;
  return rig;
}

constexpr double kStep = 0.7;

std::optional<Rigid3> place(std::int64_t frame) {
  Rigid3 pose;
  pose.translation = {kStep * static_cast<double>(frame), 0, 0};
  return pose;
}

SurfaceMesh mesh_of(const std::vector<Profile>& profiles, const MeshOptions& options = {}) {
  const TempFolder folder;
  write_cloud(folder.path() / "cloud.ply", profiles);
  return mesh_cloud(folder.path() / "cloud.ply", rig_above(), place, options);
}

std::vector<Profile> scan_of(const std::function<double(double, double)>& surface, int frames = 20) {
  std::vector<Profile> profiles;
  for (int k = 0; k < frames; ++k) profiles.push_back(stripe_over(k, k * kStep, surface));
  return profiles;
}

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum +=
        0.5 *
        (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm();
  return sum;
}

/// Directed edges: in an oriented manifold each occurs once at most.
void expect_manifold(const SurfaceMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second) << "edge used twice the same way";
}

TEST(SurfaceMesh, APlaneIsOneSheetOfItsArea) {
  const SurfaceMesh mesh = mesh_of(scan_of([](double, double y) { return 0.5 * y; }));
  expect_manifold(mesh);
  EXPECT_NEAR(area(mesh), 19 * kStep * 39.91 * std::sqrt(1.25), 0.2);
  EXPECT_EQ(mesh.vertices.size(), 20U * 308U);
  for (const auto& normal : mesh.normals) EXPECT_GT(normal.z(), 0.89F);  // to the sensor
}

TEST(SurfaceMesh, JumpsAndGapsStayOpen) {
  const SurfaceMesh mesh = mesh_of(scan_of([](double x, double y) {
    if (y > 5 && y < 9) return std::numeric_limits<double>::quiet_NaN();
    return x > 7 ? 12.0 : 0.0;
  }));
  expect_manifold(mesh);
  EXPECT_NEAR(area(mesh), 18 * kStep * (39.91 - 4.13), 2.0);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE((mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm(), mesh.max_edge_mm);
}

// Lines that begin and end anywhere, in any order and either way, with noise: still a manifold.
TEST(SurfaceMesh, TornStripesStayManifold) {
  Random random(5);
  std::vector<Profile> profiles;
  for (int k = 0; k < 30; ++k) {
    const Profile whole =
        stripe_over(k, k * kStep, [](double x, double y) { return std::sin(x) + 0.02 * y * y; });
    Profile torn;
    torn.frame = k;
    for (std::size_t begin = 0; begin < whole.points.size();) {
      const std::size_t end = std::min(whole.points.size(), begin + 3 + random.bits() % 90);
      std::vector<ProfilePoint> part(whole.points.begin() + static_cast<std::ptrdiff_t>(begin),
                                     whole.points.begin() + static_cast<std::ptrdiff_t>(end));
      if (random.uniform() < 0.5) std::reverse(part.begin(), part.end());
      for (ProfilePoint& p : part) {
        p.line = static_cast<int>(begin);
        p.position += 0.05 * Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
      }
      torn.points.insert(random.uniform() < 0.5 ? torn.points.begin() : torn.points.end(), part.begin(),
                         part.end());
      begin = end + random.bits() % 3;
    }
    profiles.push_back(torn);
  }
  const SurfaceMesh mesh = mesh_of(profiles);
  EXPECT_GT(mesh.triangles.size(), 10000U);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
  for (const auto& [edge, count] : edges) EXPECT_LE(count, 2);
}

TEST(SurfaceMesh, SpacingThinsTheStripes) {
  const auto flat = [](double, double) { return 0.0; };
  const SurfaceMesh all = mesh_of(scan_of(flat)), thin = mesh_of(scan_of(flat), {.spacing_mm = 0.6});
  EXPECT_LT(thin.triangles.size() * 4, all.triangles.size());
  EXPECT_NEAR(area(thin), area(all), 0.02 * area(all));
}

TEST(SurfaceMesh, WhereTwoFansMeetTheVertexStandsThereTwice) {
  SurfaceMesh bow;
  bow.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {9, 9, 9}};
  bow.triangles = {{0, 1, 2}, {0, 3, 4}};
  make_vertices_manifold(bow);
  EXPECT_EQ(bow.vertices.size(), 6U);  // the lone one is gone, the middle is there twice
  EXPECT_NE(bow.triangles[0][0], bow.triangles[1][0]);
  EXPECT_EQ(bow.vertices[bow.triangles[0][0]], bow.vertices[bow.triangles[1][0]]);
}

TEST(SurfaceMesh, FilesHaveTheirFormatAndOthersAreRefused) {
  const SurfaceMesh mesh = mesh_of(scan_of([](double, double) { return 0.0; }));
  const TempFolder folder;
  for (const char* const name : {"a.stl", "a.ply", "a.obj"}) write_mesh(folder.path() / name, mesh, name);
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "a.stl"), 84 + 50 * mesh.triangles.size());
  std::ifstream ply(folder.path() / "a.ply");
  std::string header(2000, ' ');
  ply.read(header.data(), 2000);
  EXPECT_NE(header.find("element face " + std::to_string(mesh.triangles.size())), std::string::npos);
  EXPECT_NE(header.find("property float nx"), std::string::npos);
  EXPECT_THROW(write_mesh(folder.path() / "a.xyz", mesh, "a.xyz"), Error);
}

}  // namespace
}  // namespace lightstripe
