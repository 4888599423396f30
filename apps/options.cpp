// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"

namespace lightstripe {

CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& names) {
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  return option->type_name(fmt::format("{}", fmt::join(names, "|")))
      ->check(
          [names, list](const std::string& given) {
            return std::find(names.begin(), names.end(), given) != names.end()
                       ? std::string()
                       : fmt::format("'{}' is none of {}", given, list);
          },
          "");
}

void add_common_options(CLI::App& app, CommonOptions& options, const std::string& output_help) {
  app.add_option("-o,--output", options.output, output_help)->group("General");
  app.add_option("--threads", options.threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 1024))
      ->group("General");
  app.add_flag("--quiet", options.quiet, "print warnings and errors only")->group("General");
}

void refuse_unused(const CLI::App& command, const std::string& choice,
                   const std::function<std::string(const std::string&)>& advice) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_name(), what_to_do = advice(name);
    if (!what_to_do.empty()) throw Error(name, "says nothing to " + choice, what_to_do);
  }
}

void add_field_options(CLI::App& app, const std::string& prefix, const std::vector<FieldText>& fields,
                       Overrides& overrides) {
  const std::string origin = prefix.empty() ? "" : "--" + prefix.substr(0, prefix.size() - 1);
  for (const FieldText& field : fields) {
    std::string flag = "--" + prefix + field.key;
    std::replace(flag.begin(), flag.end(), '_', '-');
    const std::string help = field.comment + (field.value.empty() ? "" : " [" + field.value + "]");
    app.add_option_function<std::string>(
           flag,
           [&overrides, origin, key = field.key](const std::string& value) {
             overrides.push_back({origin, key, value});
           },
           help)
        ->type_name(field.type.empty() ? "VALUE" : field.type)
        ->group(prefix.empty() ? "Method" : "Over the file's " + prefix.substr(0, prefix.size() - 1));
  }
}

}  // namespace lightstripe
