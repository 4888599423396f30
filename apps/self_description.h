// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the command line says about itself, for the shell and for man: made from the same tree of commands and
// options that parses the arguments, so that neither can fall behind --help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lightstripe {

/// A bash script that completes commands, options and file names of the program `app`.
std::string bash_completion(const CLI::App& app);

/// A man page (section 1) in the macros of man(7).
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace lightstripe
