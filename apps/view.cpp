// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "core/counted.h"
#include "report/view_page.h"

namespace lightstripe {
namespace {

struct ViewArguments {
  CommonOptions common;
  ViewJob job;
};

int run_view(const ViewArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const ViewPage page = write_view_page(arguments.job);
  if (page.total == 0)
    return not_usable(arguments.job.cloud.string() + " has no points (nothing is written)");
  say(arguments.common,
      fmt::format("{} of {}, {:.1f} MB, in {:.1f} s -> {}", page.shown, counted(page.total, "point"),
                  static_cast<double>(page.bytes) / 1e6,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                  page.file.string()));
  return kExitDone;
}

}  // namespace

void add_view_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("view", "a cloud to one HTML page to look at, turn and measure in");
  auto arguments = std::make_shared<ViewArguments>();
  command->add_option("cloud", arguments->job.cloud, "cloud that reconstruct wrote (.ply or .pcd)")
      ->required();
  add_common_options(*command, arguments->common, "page (default: the cloud's name with .html)");
  command->add_option("--scan", arguments->job.scan, "scan file: the page links each point to its picture");
  command->add_option("--rig", arguments->job.rig,
                      "rig file (default: the scan's): names of the sensors, rotary axis");
  command->add_option("--nominal", arguments->job.nominal,
                      "outline (name or file): the points are also coloured by their deviation from it");
  add_choice<ObjectKind>(*command, "--kind", arguments->job.kind,
                         {{"rail", ObjectKind::kRail}, {"wheel", ObjectKind::kWheel}},
                         "what the outline is of: rail or wheel [rail]");
  command
      ->add_option("--max-points", arguments->job.max_points, "more than these are thinned evenly [1200000]")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{20'000'000}));
  command->callback([arguments, &run] {
    arguments->job.page = arguments->common.output;
    run = [arguments] { return run_view(*arguments); };
  });
}

}  // namespace lightstripe
