// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/options.h"
#include "core/counted.h"
#include "io/atomic_file.h"
#include "io/output_guard.h"
#include "io/rig_file.h"
#include "io/session_file.h"
#include "pipeline/measure_input.h"
#include "reconstruct/cloud_header.h"
#include "report/cloud_deviation.h"
#include "report/cloud_view.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  CommonOptions common;
  std::string cloud, scan, rig, nominal;
  ObjectKind kind = ObjectKind::kRail;
  std::int64_t max_points = kMaxViewPoints;
};

/// The rig of --rig, else the scan's; nothing where neither is given.
std::optional<Rig> rig_of(const ViewArguments& arguments) {
  if (!arguments.rig.empty()) return read_rig(arguments.rig);
  if (arguments.scan.empty()) return std::nullopt;
  const Scan scan = read_scan(arguments.scan);
  return read_rig(scan.folder / scan.rig);
}

int run_view(const ViewArguments& arguments) {
  const std::string output = arguments.common.output.empty()
                                 ? fs::path(arguments.cloud).replace_extension(".html").string()
                                 : arguments.common.output;
  std::vector<fs::path> inputs{arguments.cloud, arguments.rig, arguments.scan, arguments.nominal};
  if (!arguments.scan.empty()) {
    const std::vector<fs::path> pictures = files_of(read_scan(arguments.scan));
    inputs.insert(inputs.end(), pictures.begin(), pictures.end());
  }
  guard_outputs(inputs, {output});
  refuse_special_file(arguments.cloud);
  const auto start = std::chrono::steady_clock::now();
  const std::optional<Rig> rig = rig_of(arguments);
  std::optional<ReferenceShape> reference;
  FrameDeviation deviation;
  if (!arguments.nominal.empty()) {
    reference = read_reference(arguments.nominal, arguments.kind);
    deviation =
        deviation_from(*reference, rig ? rig->motion : Motion{}, inspect_cloud(arguments.cloud).origin);
  }
  CloudView view = view_of_cloud(arguments.cloud, deviation, arguments.max_points);
  if (view.total == 0) return not_usable(arguments.cloud + " has no points (nothing is written)");
  if (reference) view.nominal = reference->name();
  if (rig)
    for (const Sensor& sensor : rig->sensors) view.sensors.push_back(sensor.name);
  if (!arguments.scan.empty())
    view.links = frame_links(arguments.scan, arguments.rig, output, frames_shown(view));
  const std::string page = cloud_view_html(view);
  write_file(output, page);
  say(arguments.common,
      fmt::format("{} of {}, {:.1f} MB, in {:.1f} s -> {}", view.points.size(), counted(view.total, "point"),
                  static_cast<double>(page.size()) / 1e6,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), output));
  return kExitDone;
}

}  // namespace

void add_view_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("view", "a cloud to one HTML page to look at, turn and measure in");
  auto arguments = std::make_shared<ViewArguments>();
  command->add_option("cloud", arguments->cloud, "cloud that reconstruct wrote (.ply or .pcd)")->required();
  add_common_options(*command, arguments->common, "page (default: the cloud's name with .html)");
  command->add_option("--scan", arguments->scan, "scan file: the page links each point to its picture");
  command->add_option("--rig", arguments->rig,
                      "rig file (default: the scan's): names of the sensors, rotary axis");
  command->add_option("--nominal", arguments->nominal,
                      "outline (name or file): the points are also coloured by their deviation from it");
  add_choice<ObjectKind>(*command, "--kind", arguments->kind,
                         {{"rail", ObjectKind::kRail}, {"wheel", ObjectKind::kWheel}},
                         "what the outline is of: rail or wheel [rail]");
  command->add_option("--max-points", arguments->max_points, "more than these are thinned evenly [1200000]")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{20'000'000}));
  command->callback([arguments, &run] { run = [arguments] { return run_view(*arguments); }; });
}

}  // namespace lightstripe
