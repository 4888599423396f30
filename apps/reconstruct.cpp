// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/reconstruct.h"

#include <fmt/format.h>

#include <memory>

namespace lightstripe {
namespace {

constexpr std::size_t kMaxShown = 5;

void warn_of_skipped(const ReconstructOutcome& outcome, const std::string& output) {
  const ScanSummary& summary = outcome.summary;
  if (summary.pictures_skipped > 0)
    warn(fmt::format("{} of {} pictures are skipped", summary.pictures_skipped,
                     summary.pictures + summary.pictures_skipped));
  for (std::size_t i = 0; i < std::min(kMaxShown, outcome.skipped.size()); ++i)
    warn(fmt::format("frame {} skipped: {}", outcome.skipped[i].frame, outcome.skipped[i].picture.reason));
  if (outcome.skipped.size() > kMaxShown) warn(fmt::format("... and more, all named in {}.run.yaml", output));
  if (!outcome.duplicate_pictures.empty())
    warn(fmt::format("{} pictures have a number that another one has and are left out, the first: {}",
                     outcome.duplicate_pictures.size(), outcome.duplicate_pictures.front()));
}

void warn_of_gaps(const ScanSummary& summary) {
  if (!summary.without_position.empty())
    warn(fmt::format("{} frames have no position and are left out: {}", summary.without_position.count,
                     summary.without_position.text()));
  if (!summary.interpolated.empty())
    warn(
        fmt::format("{} frames have no travel of their own, it is interpolated between their neighbours': {}",
                    summary.interpolated.count, summary.interpolated.text()));
  if (summary.frames_without_points > 0)
    warn(fmt::format("{} frames show no stripe", summary.frames_without_points));
  if (summary.rays_missed > 0)
    warn(fmt::format("{} stripe points have no certain laser plane, or do not meet it, and are left out",
                     summary.rays_missed));
}

/// Why there is nothing, and what helps.
std::string why_empty(const ReconstructOutcome& outcome) {
  const ScanSummary& summary = outcome.summary;
  if (summary.frames == 0)
    return "none of the frames has a position (nothing is written); number the travel table's frames as the "
           "pictures";
  std::string text =
      fmt::format("no stripe was found in any of the {} frames (nothing is written); ", summary.frames);
  constexpr int kDark = 60;
  if (outcome.brightest < kDark)
    text +=
        fmt::format("the pictures are dark, grey level {} at most: expose longer, or switch the laser on; ",
                    outcome.brightest);
  return text + "look at a frame with `lightstripe extract --overlay`";
}

int run_reconstruct(const ReconstructArguments& arguments) {
  if (arguments.dry_run) {
    const auto [first, end] = frames_to_reconstruct(arguments);
    fmt::print("frames: {}:{}\n", first, end);
    return kExitDone;
  }
  const std::string output = arguments.common.output.empty() ? "cloud.ply" : arguments.common.output;
  const ReconstructOutcome outcome = reconstruct_scan(arguments);
  const ScanSummary& summary = outcome.summary;
  warn_of_skipped(outcome, output);
  warn_of_gaps(summary);
  if (summary.stopped)
    return not_usable(
        fmt::format("interrupted before frame {}; what is done is kept in {}; --resume goes on from there",
                    outcome.end_frame, outcome.partial_cloud));
  if (summary.points == 0) return not_usable(why_empty(outcome));
  say(arguments.common,
      fmt::format("{} frames, {} points in {:.2f} s ({:.1f} frames/s) -> {}", summary.frames, summary.points,
                  outcome.seconds, static_cast<double>(outcome.frames_now) / outcome.seconds, output));
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
  command->add_flag("--resume", arguments->resume, "go on where an interrupted run was ended");
  command
      ->add_option("--checkpoint", arguments->checkpoint_s,
                   "seconds between the places where a run can be resumed [1]")
      ->check(CLI::Range(0.0, 3600.0));
  add_field_options<ExtractionOptions>(*command, "extraction.", arguments->extraction);
  command->callback([arguments, &run] { run = [arguments] { return run_reconstruct(*arguments); }; });
}

}  // namespace lightstripe
