// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Options of the command line: the common ones, and one for each field of an options struct.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "io/yaml_binding.h"

namespace lightstripe {

/// --threads, --quiet, -o/--output. `output_help` says what is written and where if it is not given.
void add_common_options(CLI::App& app, CommonOptions& options, const std::string& output_help);

/// An option that was given and would do nothing with this choice ("--kind rail") is a mistake: an Error.
/// `advice(option's name)` says what to do then; it is empty where the option does something.
void refuse_unused(const CLI::App& command, const std::string& choice,
                   const std::function<std::string(const std::string&)>& advice);

/// Makes an option take one of these names only; --help, messages and the shell's completion list them.
CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& names);

/// An option whose value goes by its name.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, T& value,
                        const std::vector<std::pair<std::string, T>>& choices, const std::string& help) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  const auto take = [&value, choices](const std::string& given) {
    for (const auto& [name, meant] : choices)
      if (name == given) value = meant;
  };
  return one_of(app.add_option_function<std::string>(flag, take, help), names);
}

/// An option of a field list as given on the command line, applied after the files were read.
struct Override {
  std::string origin, field, value;  ///< origin: "--extraction" of --extraction.stripe-width, for messages
};
using Overrides = std::vector<Override>;

/// A command line option for each of these fields.
void add_field_options(CLI::App& app, const std::string& prefix, const std::vector<FieldText>& fields,
                       Overrides& overrides);

/// One command line option for each field of T: stripe_width with prefix "extraction." becomes
/// --extraction.stripe-width. The same field list reads the YAML files, so that no name or default is written
/// twice.
template <HasFields T>
void add_field_options(CLI::App& app, const std::string& prefix, Overrides& overrides,
                       const T& defaults = T{}) {
  add_field_options(app, prefix, list_fields(defaults), overrides);
}

template <HasFields T>
void apply_overrides(T& options, const Overrides& overrides) {
  for (const auto& given : overrides) set_field(options, given.field, given.value, given.origin);
}

}  // namespace lightstripe
