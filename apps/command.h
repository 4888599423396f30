// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What all commands share: exit codes, common options, options from field lists, lines on stdout and stderr.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/fields.h"
#include "io/yaml_binding.h"

namespace lightstripe {

enum ExitCode : int { kExitDone = 0, kExitInputWrong = 1, kExitUsage = 2, kExitNotUsable = 3 };

struct CommonOptions {
  int threads = 0;  ///< 0 = all cores
  bool quiet = false;
  std::string output;
};

/// A subcommand's function, to be run after parsing; returns the exit code.
using Command = std::function<int()>;

/// --threads, --quiet, -o/--output. `output_help` says what is written and where if it is not given.
void add_common_options(CLI::App& app, CommonOptions& options, const std::string& output_help);

/// Threads that a stage may use: the option, or all cores.
int thread_count(const CommonOptions& options);

/// Limits oneTBB and OpenCV to the threads of the option for as long as it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(const CommonOptions& options);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  Impl* impl_;
};

/// An option of a field list as given on the command line, applied after the files were read.
struct Override {
  std::string origin, field, value;  ///< origin: "--extraction" of --extraction.stripe-width, for messages
};
using Overrides = std::vector<Override>;

/// One command line option for each field of T: stripe_width with prefix "extraction." becomes
/// --extraction.stripe-width. The same field list reads the YAML files, so that no name or default is written
/// twice.
template <HasFields T>
void add_field_options(CLI::App& app, const std::string& prefix, Overrides& overrides) {
  const std::string origin = prefix.empty() ? "" : "--" + prefix.substr(0, prefix.size() - 1);
  for (const FieldText& field : list_fields(T{})) {
    std::string flag = "--" + prefix + field.key;
    std::replace(flag.begin(), flag.end(), '_', '-');
    const std::string help = field.comment + (field.value.empty() ? "" : " [" + field.value + "]");
    app.add_option_function<std::string>(
           flag,
           [&overrides, origin, key = field.key](const std::string& value) {
             overrides.push_back({origin, key, value});
           },
           help)
        ->group(prefix.empty() ? "Method" : "Over the file's " + prefix.substr(0, prefix.size() - 1));
  }
}

template <HasFields T>
void apply_overrides(T& options, const Overrides& overrides) {
  for (const auto& given : overrides) set_field(options, given.field, given.value, given.origin);
}

/// A line for the user on stdout, unless quiet.
void say(const CommonOptions& options, const std::string& line);
/// "warning: ..." on stderr, also when quiet.
void warn(const std::string& line);
/// "not usable: ..." on stderr; returns exit code 3.
int not_usable(const std::string& reason);

void add_extract_command(CLI::App& app, Command& run);
void add_calibrate_command(CLI::App& app, Command& run);
void add_reconstruct_command(CLI::App& app, Command& run);
void add_merge_command(CLI::App& app, Command& run);
void add_simulate_command(CLI::App& app, Command& run);
void add_demo_command(CLI::App& app, Command& run);
void add_measure_command(CLI::App& app, Command& run);
void add_verify_command(CLI::App& app, Command& run);
void add_bench_command(CLI::App& app, Command& run);
void add_generate_command(CLI::App& app, Command& run);
void add_view_command(CLI::App& app, Command& run);

}  // namespace lightstripe
