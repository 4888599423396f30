// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A camera's pictures to a folder.
#include "pipeline/record_frames.h"

#include <fmt/format.h>

#include <memory>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/live_options.h"
#include "apps/options.h"
#include "apps/status_line.h"
#include "core/counted.h"
#include "core/error.h"

namespace lightstripe {
namespace {

struct RecordArguments {
  CommonOptions common;
  RecordJob job;
  std::string format = "pgm";
};

int run_record(RecordArguments arguments) {
  RecordJob& job = arguments.job;
  job.folder = arguments.common.output;
  job.format = arguments.format == "png" ? PictureFormat::kPng : PictureFormat::kPgm;
  refuse_two_travels(job.travel);
  const InterruptWatch interrupt;
  StatusLine line(arguments.common.quiet);
  const RecordSummary summary = record_frames(job, interrupt.token(), [&](const RecordSummary& now) {
    line.show([&] {
      return fmt::format("recording: {}, {:.1f}/s, {} lost, {} incomplete", counted(now.frames, "frame"),
                         static_cast<double>(now.frames) / std::max(now.seconds, 1e-3), now.lost,
                         now.incomplete);
    });
  });
  line.clear();
  if (summary.lost + summary.incomplete > 0)
    warn(fmt::format("{} lost and {} incomplete, all named in frames.csv: {}",
                     counted(summary.lost, "frame is", "frames are"), summary.incomplete,
                     summary.first_missing));
  if (summary.whole == 0) return not_usable("no whole frame arrived; look at frames.csv for the reasons");
  say(arguments.common, fmt::format("{} in {:.2f} s ({:.1f} frames/s), {} of them whole -> {}",
                                    counted(summary.frames, "frame"), summary.seconds,
                                    static_cast<double>(summary.frames) / std::max(summary.seconds, 1e-3),
                                    summary.whole, job.folder.string()));
  return kExitDone;
}

}  // namespace

void add_record_command(CLI::App& app, Command& run) {
  auto* command =
      app.add_subcommand("record", "a camera's pictures to a folder, with travel and every lost frame named");
  auto arguments = std::make_shared<RecordArguments>();
  command->add_option("source", arguments->job.source, kSourceHelp)->required();
  add_common_options(*command, arguments->common,
                     "folder for the pictures, or one growing file FILE.tif (required)");
  command->get_option("--output")->required();
  one_of(command->add_option("--format", arguments->format, "pgm (fast) or png (smaller) [pgm]"),
         {"pgm", "png"});
  add_live_options(*command, arguments->job.max_frames, arguments->job.max_seconds, arguments->job.travel);
  command->callback([arguments, &run] { run = [arguments] { return run_record(*arguments); }; });
}

}  // namespace lightstripe
