// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a reconstruction can make of its cloud besides: filtered points, height map, mesh, a page to look at.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/reconstruct_job.h"
#include "reconstruct/cloud_filter.h"
#include "reconstruct/height_map.h"
#include "reconstruct/surface_mesh.h"

namespace lightstripe {

struct ScanProducts {
  std::optional<CloudFilter> filter;  ///< the cloud file itself is replaced; profiles.csv is not touched
  std::filesystem::path height_map;   ///< .tif; empty: none
  HeightMapOptions map;
  std::filesystem::path mesh;  ///< .stl, .ply or .obj; empty: none
  MeshOptions mesh_options;
  std::filesystem::path view;  ///< .html; empty: none
  bool any() const { return filter || !height_map.empty() || !mesh.empty() || !view.empty(); }
};

/// Refuses names whose format is not known, before the work begins.
void check_scan_products(const ReconstructJob& job, const ScanProducts& products);

/// Makes the job write them at its end, behind what it does there already; none of them may be its input.
/// `made` gets a line for each. All three have to live as long as the job.
void make_products_of(ReconstructJob& job, const ScanProducts& products, std::vector<std::string>& made);

/// From the job's finished cloud. Returns what was made, a line each.
std::vector<std::string> write_scan_products(const ReconstructJob& job, const ScanProducts& products);

}  // namespace lightstripe
