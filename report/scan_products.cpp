// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/scan_products.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/counted.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "pipeline/height_map_files.h"
#include "pipeline/recording.h"
#include "reconstruct/cloud_header.h"
#include "report/cloud_view.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

std::string filter_in_place(const fs::path& cloud, const CloudFilter& filter) {
  std::vector<CloudPoint> points = read_cloud(cloud);
  const std::size_t before = points.size();
  points = filter_cloud(std::move(points), filter);
  const CloudPart part = inspect_cloud(cloud);
  std::string bytes = cloud_header(part.format, static_cast<std::int64_t>(points.size()), part.origin);
  bytes.append(reinterpret_cast<const char*>(points.data()), points.size() * sizeof(CloudPoint));
  write_file(cloud, bytes);
  return fmt::format("filter: {} of {} {} -> {}", points.size(), counted(before, "point"),
                     noun_of(points.size(), "stays", "stay"), cloud.string());
}

std::string make_map(const ReconstructJob& job, const ScanProducts& products) {
  const HeightMap map = make_height_map(job.cloud, job.rig.motion, products.map);
  write_height_map(products.height_map, map);
  const auto known =
      std::count_if(map.heights.begin(), map.heights.end(), [](float z) { return !std::isnan(z); });
  return fmt::format("height map of {} x {} pixels, {:.1f} % known -> {}", map.width, map.height,
                     100.0 * static_cast<double>(known) / static_cast<double>(map.heights.size()),
                     products.height_map.string());
}

std::string make_mesh(const ReconstructJob& job, const ScanProducts& products) {
  const Recording recording(job.scan, job.scan_file.string(), job.rig);
  const auto place = [&](std::int64_t frame) -> std::optional<Rigid3> {
    const auto position = recording.position(frame);
    if (!position) return std::nullopt;
    return result_from_rig(job.rig.motion, *position);
  };
  const SurfaceMesh mesh = mesh_cloud(job.cloud, job.rig, place, products.mesh_options);
  if (mesh.triangles.empty())
    throw Error(products.mesh.string(), "no two frames lie close enough to join",
                fmt::format("give --mesh-max-edge more than {:.3g} mm", mesh.max_edge_mm));
  AtomicFile file(products.mesh);
  write_mesh(file.temporary(), mesh, products.mesh);
  file.commit();
  return fmt::format("mesh of {}, edges up to {:.2f} mm -> {}", counted(mesh.triangles.size(), "triangle"),
                     mesh.max_edge_mm, products.mesh.string());
}

std::string make_view(const ReconstructJob& job, const ScanProducts& products) {
  CloudView view = view_of_cloud(job.cloud);
  for (const Sensor& sensor : job.rig.sensors) view.sensors.push_back(sensor.name);
  view.links = frame_links(job.scan_file.string(), job.rig_file.string(), products.view, frames_shown(view));
  write_file(products.view, cloud_view_html(view));
  return fmt::format("view of {} of {} -> {}", view.points.size(), counted(view.total, "point"),
                     products.view.string());
}

}  // namespace

void check_scan_products(const ReconstructJob& job, const ScanProducts& products) {
  if (!products.any()) return;
  if (cloud_format(job.cloud, job.cloud.string()) == CloudFormat::kXyz)
    throw Error(job.cloud.string(), "an .xyz file has no intensity, frame and sigma to make more of",
                "name the cloud .ply or .pcd");
  if (!products.height_map.empty()) check_height_map_name(products.height_map);
  if (!products.mesh.empty()) check_mesh_name(products.mesh);
}

std::vector<std::string> write_scan_products(const ReconstructJob& job, const ScanProducts& products) {
  std::vector<std::string> lines;
  if (products.filter) lines.push_back(filter_in_place(job.cloud, *products.filter));
  if (!products.height_map.empty()) lines.push_back(make_map(job, products));
  if (!products.mesh.empty()) lines.push_back(make_mesh(job, products));
  if (!products.view.empty()) lines.push_back(make_view(job, products));
  return lines;
}

void make_products_of(ReconstructJob& job, const ScanProducts& products, std::vector<std::string>& made) {
  if (!products.any()) return;
  for (const std::filesystem::path& output : {products.view, products.height_map, products.mesh})
    if (!output.empty()) job.other_outputs.push_back(output);
  if (!products.height_map.empty())
    job.other_outputs.push_back(std::filesystem::path(products.height_map).replace_extension(".png"));
  job.before_end = [&job, &products, &made, before = job.before_end] {
    if (before) before();
    made = write_scan_products(job, products);
  };
}

}  // namespace lightstripe
