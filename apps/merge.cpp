// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/merge_job.h"

#include <fmt/format.h>

#include "apps/command.h"
#include "apps/options.h"
#include "core/counted.h"

namespace lightstripe {

void add_merge_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand(
      "merge", "joins clouds (.ply .pcd .xyz) or tables of sections (.csv) of parts of a scan");
  struct Arguments {
    CommonOptions common;
    MergeJob job;
  };
  auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("parts", arguments->job.parts,
                   "files of the parts, in any order (.xyz: in order of frames)")
      ->required();
  add_common_options(*command, arguments->common, "the joined file (required)");
  command->get_option("--output")->required();
  command->callback([arguments, &run] {
    run = [arguments] {
      MergeJob& job = arguments->job;
      job.output = arguments->common.output;
      const MergeResult result = merge(job);
      for (const std::string& warning : result.warnings) warn(warning);
      say(arguments->common, fmt::format("{} -> {}", counted(job.parts.size(), "part"), job.output.string()));
      return kExitDone;
    };
  });
}

}  // namespace lightstripe
