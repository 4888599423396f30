// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// By hand: PCL's writers would link VTK, MPI and Qt into the program for thirty lines.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "reconstruct/surface_mesh.h"

namespace lightstripe {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(file.flush());
}

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

void put_vector(std::string& bytes, const Eigen::Vector3f& v) {
  for (const float c : {v.x(), v.y(), v.z()}) put(bytes, c);
}

std::string ply_text(const SurfaceMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment lightstripe, mm\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    put_vector(bytes, mesh.vertices[i]), put_vector(bytes, mesh.normals[i]);
  for (const auto& t : mesh.triangles) {
    put(bytes, std::uint8_t{3});
    for (const std::uint32_t v : t) put(bytes, v);
  }
  return bytes;
}

std::string obj_text(const SurfaceMesh& mesh) {
  std::string text = "# lightstripe, mm\n";
  for (const auto& v : mesh.vertices)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& n : mesh.normals)
    fmt::format_to(std::back_inserter(text), "vn {:.6f} {:.6f} {:.6f}\n", n.x(), n.y(), n.z());
  for (const auto& t : mesh.triangles)
    fmt::format_to(std::back_inserter(text), "f {0}//{0} {1}//{1} {2}//{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string stl_text(const SurfaceMesh& mesh) {
  std::string bytes(80, ' ');
  bytes.replace(0, 15, "lightstripe, mm");  // must not begin with "solid"
  put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f p = mesh.vertices[t[0]], q = mesh.vertices[t[1]], r = mesh.vertices[t[2]];
    put_vector(bytes, (q - p).cross(r - p).normalized());
    for (const auto& corner : {p, q, r}) put_vector(bytes, corner);
    put(bytes, std::uint16_t{0});
  }
  return bytes;
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
  const bool done = write_bytes(path, extension == ".stl"   ? stl_text(mesh)
                                      : extension == ".ply" ? ply_text(mesh)
                                                            : obj_text(mesh));
  if (!done)
    throw Error(name.string(), "cannot be written",
                "check the folder, its permissions and the space left on the disk");
}

}  // namespace lightstripe
