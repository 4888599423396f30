// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// .ply and .obj are PCL's; .stl is written by hand, since PCL does so through VTK, which would bring in MPI
// and Qt.
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/io/obj_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "core/error.h"
#include "reconstruct/surface_mesh.h"

namespace lightstripe {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

pcl::PolygonMesh pcl_mesh(const SurfaceMesh& mesh) {
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.reserve(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    pcl::PointNormal p;
    p.getVector3fMap() = mesh.vertices[i];
    p.getNormalVector3fMap() = mesh.normals[i];
    p.curvature = 0;
    cloud.push_back(p);
  }
  pcl::PolygonMesh out;
  pcl::toPCLPointCloud2(cloud, out.cloud);
  out.polygons.resize(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t v : mesh.triangles[i])
      out.polygons[i].vertices.push_back(static_cast<pcl::index_t>(v));
  return out;
}

bool write_stl(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  std::string bytes(80, ' ');
  bytes.replace(0, 15, "lightstripe, mm");  // must not begin with "solid"
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  const auto put_vector = [&](const Eigen::Vector3f& v) { put(v.x()), put(v.y()), put(v.z()); };
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f p = mesh.vertices[t[0]], q = mesh.vertices[t[1]], r = mesh.vertices[t[2]];
    put_vector((q - p).cross(r - p).normalized());
    put_vector(p), put_vector(q), put_vector(r);
    put(std::uint16_t{0});
  }
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(file.flush());
}

}  // namespace

void check_mesh_name(const std::filesystem::path& name) {
  const std::string extension = lower(name.extension().string());
  if (extension != ".stl" && extension != ".ply" && extension != ".obj")
    throw Error(name.string(), "'" + extension + "' is no format for a mesh", "name it .stl, .ply or .obj");
}

void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh,
                const std::filesystem::path& name) {
  check_mesh_name(name);
  const std::string extension = lower(name.extension().string());
  const bool done = extension == ".stl"   ? write_stl(path, mesh)
                    : extension == ".ply" ? pcl::io::savePLYFileBinary(path.string(), pcl_mesh(mesh)) == 0
                                          : pcl::io::saveOBJFile(path.string(), pcl_mesh(mesh), 9) == 0;
  if (!done)
    throw Error(name.string(), "cannot be written",
                "check the folder, its permissions and the space left on the disk");
}

}  // namespace lightstripe
