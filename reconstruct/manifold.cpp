// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/manifold.h"

#include <numeric>

namespace lightstripe {
namespace {

using Index = std::uint32_t;

/// Corners (triangle * 3 + place) by vertex.
struct Corners {
  std::vector<Index> begin, corner;
};

Corners corners_of(const SurfaceMesh& mesh) {
  Corners out;
  out.begin.assign(mesh.vertices.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (const Index v : t) ++out.begin[v + 1];
  std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
  out.corner.resize(mesh.triangles.size() * 3);
  std::vector<Index> next(out.begin.begin(), out.begin.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      out.corner[next[mesh.triangles[t][k]]++] = static_cast<Index>(3 * t + k);
  return out;
}

/// Fan of each corner of one vertex, numbered from 0: corners whose triangles share an edge are of one fan.
std::vector<int> fans(const SurfaceMesh& mesh, const Index* corner, std::size_t count) {
  std::vector<int> fan(count, -1);
  const auto other = [&](std::size_t c, unsigned step) {
    return mesh.triangles[corner[c] / 3][(corner[c] % 3 + step) % 3];
  };
  const auto share_edge = [&](std::size_t c, std::size_t d) {
    for (const unsigned i : {1U, 2U})
      for (const unsigned j : {1U, 2U})
        if (other(c, i) == other(d, j)) return true;
    return false;
  };
  int num_fans = 0;
  for (std::size_t first = 0; first < count; ++first) {
    if (fan[first] >= 0) continue;
    std::vector<std::size_t> open{first};
    fan[first] = num_fans;
    while (!open.empty()) {
      const std::size_t c = open.back();
      open.pop_back();
      for (std::size_t d = 0; d < count; ++d)
        if (fan[d] < 0 && share_edge(c, d)) fan[d] = num_fans, open.push_back(d);
    }
    ++num_fans;
  }
  return fan;
}

}  // namespace

void make_vertices_manifold(SurfaceMesh& mesh) {
  const Corners corners = corners_of(mesh);
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<Index, 3>> triangles = mesh.triangles;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Index* const corner = corners.corner.data() + corners.begin[v];
    const std::size_t count = corners.begin[v + 1] - corners.begin[v];
    const std::vector<int> fan = fans(mesh, corner, count);
    const auto first = static_cast<Index>(vertices.size());
    for (std::size_t c = 0; c < count; ++c) {
      const auto place = first + static_cast<Index>(fan[c]);
      if (place == vertices.size()) vertices.push_back(mesh.vertices[v]);
      triangles[corner[c] / 3][corner[c] % 3] = place;
    }
  }
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
}

}  // namespace lightstripe
