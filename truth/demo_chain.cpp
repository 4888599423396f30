// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/demo_chain.h"

#include <fmt/format.h>

#include "extraction/draw/overlay.h"
#include "extraction/extract_stripes.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/session_file.h"
#include "pipeline/measure_job.h"
#include "report/calibration_report.h"
#include "report/measure_report.h"
#include "report/preview.h"
#include "report/scan_products.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// The middle frame of each sensor with the lines drawn in.
std::vector<RgbPicture> draw_overlays(const Scan& scan, const fs::path& folder) {
  std::vector<RgbPicture> overlays;
  for (const auto& [sensor, pattern] : scan.frames) {
    const auto files = list_files(scan.folder, pattern);
    const Image8 image = read_image(files[files.size() / 2], scan.channel);
    ExtractionOptions options = scan_extraction();
    read_subtree(scan.extraction, options);
    overlays.push_back(
        {draw_overlay(image, extract_stripes(image, options).stripes), image.width, image.height});
    write_rgb_image(folder / (sensor + ".png"), overlays.back().pixels, image.width, image.height);
  }
  return overlays;
}

}  // namespace

std::set<std::string> demo_files(const Scene& scene) {
  std::set<std::string> files{"rig.yaml",
                              "rig.yaml.run.yaml",
                              "calibration.html",
                              "cloud.ply",
                              "cloud.ply.run.yaml",
                              "cloud.partial.ply",
                              "cloud.html",
                              "cloud.png",
                              "profiles.csv",
                              "profiles.csv.run.yaml",
                              "profiles.partial.csv",
                              "map.tif",
                              "map.png",
                              "mesh.stl",
                              "measurements.csv",
                              "measurements.csv.run.yaml",
                              "measure.html",
                              "overview.png"};
  for (const SceneSensor& sensor : scene.sensors) files.insert("overlay/" + sensor.name + ".png");
  return files;
}

CalibrateResult calibrate_rendered(const SimulationSummary& simulated, const fs::path& folder, int threads) {
  CalibrateJob job = read_calibrate_job(simulated.session);
  job.rig = folder / "rig.yaml";
  job.threads = threads;
  CalibrateResult result = calibrate(job);
  write_file(folder / "calibration.html", calibration_report(result.seen, result.calibration));
  return result;
}

ReconstructResult reconstruct_rendered(const SimulationSummary& simulated, const fs::path& folder,
                                       int threads, const std::stop_token& stop) {
  ReconstructJob job = read_reconstruct_job(simulated.scan);
  job.cloud = folder / "cloud.ply";
  job.profiles = folder / "profiles.csv";
  job.threads = threads;
  CloudPreview preview;
  draw_preview_of(job, preview, folder / "cloud.png");
  ScanProducts products;
  products.view = folder / "cloud.html", products.height_map = folder / "map.tif",
  products.mesh = folder / "mesh.stl";
  std::vector<std::string> made;
  make_products_of(job, products, made);
  return reconstruct(job, {}, stop);
}

void write_overview(const fs::path& scan, const std::vector<Profile>& profiles, const fs::path& folder) {
  CloudPreview cloud;
  for (const auto& profile : profiles) cloud.add(profile);
  const RgbPicture overview =
      compose_overview(draw_overlays(read_scan(scan), folder / "overlay"), cloud.draw(1200, 520));
  write_rgb_image(folder / "overview.png", overview.pixels, overview.width, overview.height);
}

MeasuredWear measure_rendered(const Scene& scene, const SimulationSummary& simulated, const fs::path& folder,
                              int threads) {
  if (!fs::exists(simulated.truth / "wear.csv")) return {};
  MeasureJob job;
  job.profiles = folder / "profiles.csv";
  job.kind = scene.turns() ? ObjectKind::kWheel : ObjectKind::kRail;
  job.reference.nominal = scene.turns() ? scene.wheel.profile : scene.rail.profile;
  job.rig = folder / "rig.yaml";
  job.table = folder / "measurements.csv";
  job.threads = threads;
  const MeasureResult result = measure(job);
  const fs::path page = folder / "measure.html";
  write_file(page, measure_report_html(job, result, {page, simulated.scan, "cloud.html"}));
  if (result.num_ok == 0) return {{}, result.warnings};
  return {compare_wear(result.rows, job.kind, simulated.truth), result.warnings};
}

std::string list_demo_files(const fs::path& folder, bool measured) {
  return fmt::format(
      "\nlook       {0}/cloud.html (in a browser)\n"
      "cloud      {0}/cloud.ply (picture: {0}/cloud.png)\nheight map {0}/map.tif\n"
      "mesh       {0}/mesh.stl\nsections   {0}/profiles.csv\n"
      "{1}overlays   {0}/overlay/*.png\nrig        {0}/rig.yaml (report: {0}/calibration.html)\n"
      "truth      {0}/truth/",
      folder.string(),
      measured ? fmt::format("measured   {0}/measurements.csv (report: {0}/measure.html)\n", folder.string())
               : "");
}

}  // namespace lightstripe
