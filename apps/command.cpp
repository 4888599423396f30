// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"

#include <fmt/format.h>

#include <cstdio>

namespace lightstripe {

void say(const CommonOptions& options, const std::string& line) {
  if (!options.quiet) fmt::print("{}\n", line);
}

void warn(const std::string& line) { fmt::print(stderr, "warning: {}\n", line); }

int not_usable(const std::string& reason) {
  fmt::print(stderr, "not usable: {}\n", reason);
  return kExitNotUsable;
}

}  // namespace lightstripe
