// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What all commands share: exit codes, common options, lines on stdout and stderr.
#pragma once

#include <functional>
#include <string>

#include "report/message.h"

namespace CLI {
class App;
}

namespace lightstripe {

enum ExitCode : int { kExitDone = 0, kExitInputWrong = 1, kExitUsage = 2, kExitNotUsable = 3 };

struct CommonOptions {
  int threads = 0;  ///< 0 = all cores
  bool quiet = false;
  std::string output;
};

/// A subcommand's function, to be run after parsing; returns the exit code.
using Command = std::function<int()>;

/// A line for the user on stdout, unless quiet.
void say(const CommonOptions& options, const std::string& line);
/// "warning: ..." on stderr, also when quiet.
void warn(const std::string& line);
/// Says or warns each of them.
void tell(const CommonOptions& options, const Messages& messages);
/// "error: ..." on stderr.
void say_error(const std::string& line);
/// A line on stderr that is neither.
void say_status(const std::string& line);
/// A result that goes to stdout itself; an Error where it cannot be written.
void print_result(const std::string& text);
/// "not usable: ..." on stderr; returns exit code 3.
int not_usable(const std::string& reason);

void add_extract_command(CLI::App& app, Command& run);
void add_calibrate_command(CLI::App& app, Command& run);
void add_reconstruct_command(CLI::App& app, Command& run);
void add_merge_command(CLI::App& app, Command& run);
void add_record_command(CLI::App& app, Command& run);
void add_live_command(CLI::App& app, Command& run);
void add_simulate_command(CLI::App& app, Command& run);
void add_demo_command(CLI::App& app, Command& run);
void add_measure_command(CLI::App& app, Command& run);
void add_conicity_command(CLI::App& app, Command& run);
void add_verify_command(CLI::App& app, Command& run);
void add_bench_command(CLI::App& app, Command& run);
void add_generate_command(CLI::App& app, Command& run);
void add_view_command(CLI::App& app, Command& run);
void add_design_command(CLI::App& app, Command& run);

}  // namespace lightstripe
