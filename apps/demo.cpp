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
#include "io/output_guard.h"
#include "io/own_files.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "pipeline/job.h"
#include "truth/accuracy_table.h"
#include "truth/compare_with_truth.h"
#include "truth/demo_chain.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

int run_demo(const std::string& scene_file, bool wheel, const CommonOptions& common) {
  const fs::path folder = common.output.empty() ? "demo-output" : common.output;
  const Scene scene = !scene_file.empty() ? read_scene(scene_file) : wheel ? wheel_scene() : Scene{};
  const std::set<std::string> results = demo_files(scene);
  std::vector<fs::path> outputs;
  for (const std::string& file : results) outputs.push_back(folder / file);
  guard_marked_outputs({scene_file}, outputs);
  OwnFiles own(folder, ".lightstripe-demo");
  own.refuse_foreign(results);
  say(common, fmt::format("1/4 rendering a calibration session and a scan of a {}",
                          scene.turns() ? "turning wheel" : "rail"));
  const SimulationSummary simulated =
      simulate_with_progress(scene, scene_file, {common.threads, common.quiet, folder.string()});

  own.claim(results);  // an earlier demo's own are replaced, nobody else's
  say(common, "2/4 calibrating the rig from the board images");
  const CalibrateResult calibration = calibrate_rendered(simulated, folder, common.threads);
  for (const std::string& warning : calibration.warnings) warn(warning);
  if (!calibration.usable()) return not_usable(calibration.not_usable);

  say(common, "3/4 reconstructing the scan");
  const ReconstructResult scanned = [&] {
    const InterruptWatch interrupt;
    return reconstruct_rendered(simulated, folder, common.threads, interrupt.token());
  }();
  if (!scanned.usable()) return not_usable(scanned.not_usable);
  const std::vector<Profile> profiles = read_profiles(folder / "profiles.csv");
  write_overview(simulated.scan, profiles, folder);

  say(common, "4/4 measuring the sections\n");
  const auto [wear, warnings] = measure_rendered(scene, simulated, folder, common.threads);
  for (const std::string& warning : warnings) warn(warning);

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
  say(common, list_demo_files(folder, !wear.empty()));
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
