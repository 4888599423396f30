// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/reconstruct_job.h"

#include <fmt/format.h>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/options.h"
#include "apps/progress.h"
#include "core/error.h"
#include "io/number_text.h"
#include "report/growing_view.h"
#include "report/preview.h"
#include "report/scan_products.h"
#include "report/scan_text.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct ReconstructArguments {
  CommonOptions common;
  std::string scan, rig, profiles, preview;
  std::string frames;  ///< "A:B": frames A to B - 1; either may be left out
  bool strict = false, resume = false;
  bool follow = false;
  double idle_s = 0;
  bool dry_run = false;  ///< only tell which frames there are
  double checkpoint_s = 1;
  ScanProducts products;
  std::string filter;
  Overrides extraction;
};

/// "A:B", "A:", ":B".
void parse_frames(const std::string& text, ReconstructJob& job) {
  if (text.empty()) return;
  const std::size_t colon = text.find(':');
  const std::string from = text.substr(0, colon),
                    to = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (!from.empty()) job.first_frame = parse_integer(from);
  if (!to.empty()) job.end_frame = parse_integer(to);
  const bool unreadable = (!from.empty() && !job.first_frame) || (!to.empty() && !job.end_frame);
  if (colon == std::string::npos || unreadable || job.first_frame.value_or(0) < 0 ||
      (job.end_frame && *job.end_frame <= job.first_frame.value_or(0)))
    throw Error("--frames", "'" + text + "' is no range of frames", "write A:B for the frames A to B - 1");
}

ReconstructJob job_of(const ReconstructArguments& arguments) {
  ReconstructJob job = read_reconstruct_job(arguments.scan, arguments.rig);
  apply_overrides(job.extraction, arguments.extraction);
  parse_frames(arguments.frames, job);
  if (!arguments.common.output.empty()) job.cloud = arguments.common.output;
  job.profiles = arguments.profiles;
  job.strict = arguments.strict;
  job.resume = arguments.resume;
  job.checkpoint_s = arguments.checkpoint_s;
  job.follow = arguments.follow;
  job.idle_s = arguments.idle_s;
  job.threads = arguments.common.threads;
  return job;
}

ScanProducts products_of(const ReconstructArguments& arguments, const ReconstructJob& job) {
  ScanProducts products = arguments.products;
  if (!arguments.filter.empty()) products.filter = parse_cloud_filter(arguments.filter);
  check_scan_products(job, products);
  return products;
}

void add_product_options(CLI::App& command, ReconstructArguments& arguments) {
  ScanProducts& products = arguments.products;
  const auto positive = CLI::PositiveNumber;
  command.add_option("--view", products.view, "page to look at the cloud in a browser (HTML)")
      ->group("Also made");
  command
      .add_option("--height-map", products.height_map,
                  "heights on a raster (.tif, and a 16-bit .png beside it)")
      ->group("Also made");
  command.add_option("--raster", products.map.raster_mm, "of the height map, mm [1]")
      ->check(positive)
      ->group("Also made");
  command
      .add_option("--bridge", products.map.bridge_mm,
                  "height map: gaps within a stripe up to this are closed, mm [0]")
      ->check(CLI::NonNegativeNumber)
      ->group("Also made");
  command.add_option("--mesh", products.mesh, "surface of triangles (.stl, .ply, .obj)")->group("Also made");
  command
      .add_option("--mesh-max-edge", products.mesh_options.max_edge_mm,
                  "longer edges are gaps, mm [3 usual steps]")
      ->check(positive)
      ->group("Also made");
  command
      .add_option("--mesh-max-tilt", products.mesh_options.max_tilt_deg,
                  "steeper against the line of sight is a jump, degrees [85]")
      ->check(CLI::Range(1.0, 90.0))
      ->group("Also made");
  command
      .add_option("--mesh-spacing", products.mesh_options.spacing_mm,
                  "thins the stripes of the mesh, mm [all points]")
      ->check(positive)
      ->group("Also made");
  command
      .add_option("--filter", arguments.filter,
                  "of the cloud, first of all: outliers, outliers=SIGMAS, voxel=MM, joined by commas")
      ->group("Also made");
}

int run_reconstruct(const ReconstructArguments& arguments) {
  ReconstructJob job = job_of(arguments);
  if (arguments.dry_run) {
    const auto [first, end] = frames_to_reconstruct(job);
    print_result(fmt::format("frames: {}:{}\n", first, end));
    return kExitDone;
  }
  CloudPreview preview;
  const ScanProducts products = products_of(arguments, job);
  if (!arguments.preview.empty()) {
    job.other_outputs.emplace_back(arguments.preview);
    draw_preview_of(job, preview, arguments.preview);
  }
  std::optional<GrowingView> growing;
  if (job.follow && !products.view.empty()) show_growth(job, growing.emplace(job, products.view));
  std::vector<std::string> made;
  make_products_of(job, products, made);
  const InterruptWatch interrupt;
  const ReconstructResult result = reconstruct(job, progress_line(arguments.common.quiet), interrupt.token());
  tell(arguments.common, describe_scan(result, job.cloud));
  if (!result.usable()) return not_usable(result.not_usable);
  for (const std::string& line : made) say(arguments.common, line);
  return kExitDone;
}

}  // namespace

void add_reconstruct_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("reconstruct", "a recorded scan to a point cloud and sections");
  auto arguments = std::make_shared<ReconstructArguments>();
  command->add_option("scan", arguments->scan, "scan (YAML)")->required();
  add_common_options(*command, arguments->common, "cloud: .ply, .pcd or .xyz (default: cloud.ply)");
  command->add_option("--rig", arguments->rig, "rig file (default: the one that the scan names)");
  command->add_option("--profiles", arguments->profiles, "table of sections (CSV)");
  command->add_option("--preview", arguments->preview, "picture of the cloud (PNG)");
  command->add_option("--frames", arguments->frames,
                      "A:B: only the frames A to B - 1 (`lightstripe merge` joins such parts)");
  command->add_flag("--strict", arguments->strict,
                    "a picture that is missing or cannot be read ends the run");
  command->add_flag("--dry-run", arguments->dry_run,
                    "read the scan file, print the frames that would be reconstructed (A:B), and stop");
  command->add_flag(
      "--follow", arguments->follow,
      "the recording is still being written, or is a camera: go on until it is over, or Ctrl-C");
  command
      ->add_option("--idle", arguments->idle_s,
                   "with --follow: over when nothing has come for so many seconds [never]")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--resume", arguments->resume, "go on where an interrupted run was ended");
  command
      ->add_option("--checkpoint", arguments->checkpoint_s,
                   "seconds between the places where a run can be resumed [1]")
      ->check(CLI::Range(0.0, 3600.0));
  add_product_options(*command, *arguments);
  add_field_options(*command, "extraction.", arguments->extraction, scan_extraction());
  command->callback([arguments, &run] { run = [arguments] { return run_reconstruct(*arguments); }; });
}

}  // namespace lightstripe
