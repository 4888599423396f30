// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the command line says about itself, for the shell and for man: made from the same tree of commands and
// options that parses the arguments, so that neither can fall behind --help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lightstripe {

/// Types and bounds of all options in plain words, for --help: INTEGER, NUMBER, 1 to 1024.
void name_types(const CLI::App& app);

/// A bash script that completes commands, options, their values and file names of the program `app`.
std::string bash_completion(const CLI::App& app);

/// A man page (section 1) in the macros of man(7).
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace lightstripe
