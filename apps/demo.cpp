// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <set>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/options.h"
#include "apps/simulate.h"
#include "core/counted.h"
#include "extraction/draw/overlay.h"
#include "extraction/extract_stripes.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/output_guard.h"
#include "io/own_files.h"
#include "io/rig_file.h"
#include "io/session_file.h"
#include "io/tables.h"
#include "pipeline/calibrate_job.h"
#include "pipeline/measure_job.h"
#include "pipeline/reconstruct_job.h"
#include "report/calibration_report.h"
#include "report/measure_report.h"
#include "report/preview.h"
#include "report/scan_products.h"
#include "truth/accuracy_table.h"
#include "truth/compare_with_truth.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// The middle frame of each sensor with the lines drawn in.
std::vector<RgbPicture> draw_overlays(const Scan& scan, const fs::path& folder) {
  std::vector<RgbPicture> overlays;
  for (const auto& [sensor, pattern] : scan.frames) {
    const auto files = list_files(scan.folder, pattern);
    const Image8 image = read_image(files[files.size() / 2], scan.channel);
    ExtractionOptions options;
    read_subtree(scan.extraction, options);
    overlays.push_back(
        {draw_overlay(image, extract_stripes(image, options).stripes), image.width, image.height});
    write_rgb_image(folder / (sensor + ".png"), overlays.back().pixels, image.width, image.height);
  }
  return overlays;
}

/// The overlays above the cloud, in one picture.
void write_overview(const std::vector<RgbPicture>& overlays, const std::vector<Profile>& profiles,
                    const fs::path& file) {
  CloudPreview cloud;
  for (const auto& profile : profiles) cloud.add(profile);
  const RgbPicture overview = compose_overview(overlays, cloud.draw(1200, 520));
  write_rgb_image(file, overview.pixels, overview.width, overview.height);
}

/// Empty where the scene has neither rail nor wheel, or none of its sections could be measured.
std::vector<QuantityError> measure_wear(const Scene& scene, const SimulationSummary& simulated,
                                        const fs::path& folder, int threads) {
  if (!fs::exists(simulated.truth / "wear.csv")) return {};
  MeasureJob job;
  job.profiles = folder / "profiles.csv";
  job.kind = scene.turns() ? ObjectKind::kWheel : ObjectKind::kRail;
  job.reference.nominal = scene.turns() ? scene.wheel.profile : scene.rail.profile;
  job.rig = folder / "rig.yaml";
  job.table = folder / "measurements.csv";
  job.threads = threads;
  const MeasureResult result = measure(job);
  for (const auto& warning : result.warnings) warn(warning);
  const fs::path page = folder / "measure.html";
  write_file(page, measure_report_html(job, result, {page, simulated.scan, "cloud.html"}));
  if (result.num_ok == 0) return {};
  return compare_wear(result.rows, job.kind, simulated.truth);
}

CalibrateResult calibrate_rendered(const SimulationSummary& simulated, const fs::path& folder, int threads) {
  CalibrateJob job = read_calibrate_job(simulated.session);
  job.rig = folder / "rig.yaml";
  job.threads = threads;
  CalibrateResult result = calibrate(job);
  for (const auto& warning : result.warnings) warn(warning);
  write_file(folder / "calibration.html", calibration_report(result.seen, result.calibration));
  return result;
}

ReconstructResult reconstruct_rendered(const SimulationSummary& simulated, const fs::path& folder,
                                       int threads) {
  ReconstructJob job = read_reconstruct_job(simulated.scan);
  job.cloud = folder / "cloud.ply";
  job.profiles = folder / "profiles.csv";
  job.threads = threads;
  CloudPreview preview;
  draw_preview_of(job, preview, folder / "cloud.png");
  ScanProducts products;
  products.view = folder / "cloud.html", products.height_map = folder / "map.tif",
  products.mesh = folder / "mesh.stl";
  job.before_end = [&job, products, before = job.before_end] {
    before();
    write_scan_products(job, products);
  };
  const InterruptWatch interrupt;
  return reconstruct(job, {}, interrupt.token());
}

std::string list_of_files(const fs::path& folder, bool measured) {
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

/// The demo's own files are replaced only where an earlier demo has written them.
std::set<std::string> results_of(const Scene& scene) {
  std::set<std::string> files{"rig.yaml",
                              "rig.yaml.run.yaml",
                              "calibration.html",
                              "cloud.ply",
                              "cloud.ply.run.yaml",
                              "cloud.partial.ply",
                              "cloud.html",
                              "cloud.png",
                              "profiles.csv",
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

int run_demo(const std::string& scene_file, bool wheel, const CommonOptions& common) {
  const fs::path folder = common.output.empty() ? "demo-output" : common.output;
  const Scene scene = !scene_file.empty() ? read_scene(scene_file) : wheel ? wheel_scene() : Scene{};
  const std::set<std::string> results = results_of(scene);
  std::vector<fs::path> outputs;
  for (const std::string& file : results) outputs.push_back(folder / file);
  guard_outputs({scene_file}, outputs);
  OwnFiles own(folder, ".lightstripe-demo");
  own.refuse_foreign(results);
  say(common, fmt::format("1/4 rendering a calibration session and a scan of a {}",
                          scene.turns() ? "turning wheel" : "rail"));
  const SimulationSummary simulated =
      simulate_with_progress(scene, scene_file, {common.threads, common.quiet, folder.string()});

  own.claim(results);
  say(common, "2/4 calibrating the rig from the board images");
  const CalibrateResult calibration = calibrate_rendered(simulated, folder, common.threads);
  if (!calibration.usable()) return not_usable(calibration.not_usable);

  say(common, "3/4 reconstructing the scan");
  const ReconstructResult scanned = reconstruct_rendered(simulated, folder, common.threads);
  if (!scanned.usable()) return not_usable(scanned.not_usable);
  const std::vector<Profile> profiles = read_profiles(folder / "profiles.csv");
  write_overview(draw_overlays(read_scan(simulated.scan), folder / "overlay"), profiles,
                 folder / "overview.png");

  say(common, "4/4 measuring the sections\n");
  const std::vector<QuantityError> wear = measure_wear(scene, simulated, folder, common.threads);

  const Rig rig = read_rig(folder / "rig.yaml");
  const RigError rig_error = compare_rigs(rig, read_rig(simulated.truth / "rig.yaml"));
  const CloudError cloud_error = compare_cloud(profiles, rig, simulated.truth);
  say(common, accuracy_table(rig_error, cloud_error, wear, scene.turns()));
  say(common, fmt::format("\n{} from {} of {}, {:.0f} frames/s with {} (PNG decoding included)",
                          counted(scanned.summary.points, "point"), counted(scanned.summary.frames, "frame"),
                          counted(rig.sensors.size(), "sensor"),
                          static_cast<double>(scanned.summary.frames) / scanned.seconds,
                          counted(thread_count(common.threads), "thread")));
  own.release_missing();
  say(common, list_of_files(folder, !wear.empty()));
  return kExitDone;
}

}  // namespace

void add_demo_command(CLI::App& app, Command& run) {
  auto* command =
      app.add_subcommand("demo", "the whole chain on a built-in synthetic rig, results beside the truth");
  auto common = std::make_shared<CommonOptions>();
  auto scene = std::make_shared<std::string>();
  command->add_option("scene", *scene, "another scene (YAML) than the built-in one; see configs/scenes");
  add_common_options(*command, *common, "folder to write to (default: demo-output)");
  auto wheel = std::make_shared<bool>(false);
  command->add_flag("--wheel", *wheel, "a worn wheel on a turning stand instead of the rail");
  command->callback([scene, wheel, common, &run] {
    run = [scene, wheel, common] { return run_demo(*scene, *wheel, *common); };
  });
}

}  // namespace lightstripe
