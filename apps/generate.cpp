// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/self_description.h"
#include "io/atomic_file.h"
#include "io/output_guard.h"
#include "io/session_file.h"
#include "pipeline/conformance.h"
#include "report/board_drawing.h"

namespace lightstripe {
namespace {

struct GenerateArguments {
  CommonOptions common;
  std::string what, target, references;
};

std::string generated(const GenerateArguments& arguments, const CLI::App& app) {
  if (arguments.what == "board") return board_file_text(arguments.target, arguments.common.output);
  if (arguments.what == "conformance") return conformance_page(arguments.references);
  return arguments.what == "man-page" ? man_page(app, LIGHTSTRIPE_VERSION) : bash_completion(app);
}

int run_generate(const GenerateArguments& arguments, const CLI::App& app) {
  refuse_unused(*app.get_subcommand("generate"), arguments.what, [&](const std::string& option) {
    if (option == "--target" && arguments.what != "board") return "leave it out: it is the board's";
    return option == "--references" && arguments.what != "conformance" ? "leave it out: it is conformance's"
                                                                       : "";
  });
  std::error_code none;
  if (std::filesystem::is_regular_file(arguments.target, none))
    guard_outputs({arguments.target}, {arguments.common.output});
  const std::string text = generated(arguments, app);
  if (arguments.common.output.empty()) {
    print_result(text);
  } else {
    write_file(arguments.common.output, text);
  }
  return kExitDone;
}

}  // namespace

void add_generate_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand(
      "generate", "a calibration board to print; the man page, or the completion script for bash");
  auto arguments = std::make_shared<GenerateArguments>();
  one_of(command->add_option("what", arguments->what,
                             "board, man-page, bash-completion, or conformance (docs/conformance.md)"),
         {"board", "man-page", "bash-completion", "conformance"})
      ->required();
  command->add_option("--target", arguments->target,
                      "the board: a session file, or its target as text, e.g. '{type: circles, grid: [7, 7], "
                      "pitch: 37.5}' (default: a checkerboard of 11 x 8 inner corners, 10 mm)");
  command->add_option("--references", arguments->references,
                      "conformance: folder with reference/conicity and data/miniprof");
  add_common_options(*command, arguments->common, "file (default: standard output)");
  command->callback(
      [arguments, &app, &run] { run = [arguments, &app] { return run_generate(*arguments, app); }; });
}

}  // namespace lightstripe
