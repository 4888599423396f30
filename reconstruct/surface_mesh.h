// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Stripes of neighbouring frames zipped into a surface of triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/rig.h"
#include "core/transform.h"

namespace lightstripe {

struct MeshOptions {
  double max_edge_mm =
      0;  ///< longer: a jump or a gap, no triangle; 0: three times the usual step between frames
  double max_tilt_deg = 85;  ///< between a triangle's normal and the line of sight: above, it bridges a jump
  double spacing_mm = 0;     ///< stripes are thinned to this spacing first; 0: every point
};

struct SurfaceMesh {
  std::vector<Eigen::Vector3f> vertices, normals;       ///< mm; unit, towards the sensor
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise as the sensor sees them
  double max_edge_mm = 0;                               ///< the limit that was in effect
};

/// Where the rig stood in a frame, result_from_rig; nothing where that is not known.
using RigPlaces = std::function<std::optional<Rigid3>(std::int64_t frame)>;

/// Every sensor's surface on its own, from a cloud file. Manifold: an edge has at most two triangles, a
/// vertex one fan of them (where two would meet, it stands there twice). Not closed: what no sensor sees is
/// open.
SurfaceMesh mesh_cloud(const std::filesystem::path& cloud, const Rig& rig, const RigPlaces& places,
                       const MeshOptions& options);

/// .stl (binary), .ply (binary, with normals) or .obj. `path` may be a temporary one; `name` is what messages
/// call it and what tells the format.
void check_mesh_name(const std::filesystem::path& name);  ///< an Error for another format
void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh,
                const std::filesystem::path& name);

}  // namespace lightstripe
