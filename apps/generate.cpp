// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/self_description.h"
#include "io/atomic_file.h"

namespace lightstripe {
namespace {

struct GenerateArguments {
  CommonOptions common;
  std::string what;
};

int run_generate(const GenerateArguments& arguments, const CLI::App& app) {
  const std::string text =
      arguments.what == "man-page" ? man_page(app, LIGHTSTRIPE_VERSION) : bash_completion(app);
  if (arguments.common.output.empty()) {
    print_result(text);
  } else {
    write_file(arguments.common.output, text);
  }
  return kExitDone;
}

}  // namespace

void add_generate_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("generate", "the man page, or the completion script for bash");
  command->group("");  // for those who package the program: not in --help's list
  auto arguments = std::make_shared<GenerateArguments>();
  command->add_option("what", arguments->what, "man-page or bash-completion")
      ->required()
      ->check(CLI::IsMember({"man-page", "bash-completion"}));
  add_common_options(*command, arguments->common, "file (default: standard output)");
  command->callback(
      [arguments, &app, &run] { run = [arguments, &app] { return run_generate(*arguments, app); }; });
}

}  // namespace lightstripe
