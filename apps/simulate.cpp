// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulate.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/progress.h"
#include "apps/simulate.h"
#include "core/counted.h"
#include "io/output_guard.h"
#include "simulate/session_output.h"

namespace lightstripe {

SimulationSummary simulate_with_progress(const Scene& scene, const std::string& scene_file,
                                         const CommonOptions& common) {
  std::vector<std::filesystem::path> outputs;
  for (const std::string& file : session_files())
    outputs.push_back(std::filesystem::path(common.output) / file);
  guard_marked_outputs({scene_file}, outputs);
  const JobThreads threads(common.threads);
  const ProgressCallback draw = progress_line(common.quiet);
  return simulate_scene(scene, common.output, common.threads, [&](int done, int total) {
    if (draw) draw({"rendering", "images", done, total});
  });
}

namespace {

struct SimulateArguments {
  CommonOptions common;
  std::string scene;
  bool print_scene = false;
};

int run_simulate(const SimulateArguments& arguments) {
  if (arguments.print_scene) {
    print_result(dump_yaml(arguments.scene.empty() ? Scene{} : read_scene(arguments.scene), true));
    return kExitDone;
  }
  const SimulationSummary summary =
      simulate_with_progress(read_scene(arguments.scene), arguments.scene, arguments.common);
  say(arguments.common, fmt::format("{}; session {}, scan {}, truth {}", counted(summary.images, "image"),
                                    summary.session.string(), summary.scan.string(), summary.truth.string()));
  return kExitDone;
}

}  // namespace

void add_simulate_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("simulate", "renders a calibration session and a scan of a known scene");
  auto arguments = std::make_shared<SimulateArguments>();
  auto* scene = command->add_option("scene", arguments->scene, "scene (YAML); see configs/scenes");
  auto* print = command->add_flag("--print-scene", arguments->print_scene,
                                  "print the scene (without one: the demo's) with every key and its meaning");
  add_common_options(*command, arguments->common, "folder to write to (required)");
  command->callback([command, scene, print, arguments, &run] {
    if (print->count() == 0 && scene->count() == 0) throw CLI::RequiredError("scene");
    if (print->count() == 0 && command->get_option("--output")->count() == 0)
      throw CLI::RequiredError("--output");
    run = [arguments] { return run_simulate(*arguments); };
  });
}

}  // namespace lightstripe
