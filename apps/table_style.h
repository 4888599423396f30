// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// --csv-style of the commands that write tables for people.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace lightstripe {

enum class TableStyle { kPlain, kExcel };

void add_table_style_option(CLI::App& command, TableStyle& style);

/// Rewrites a finished .csv table in that style; other files are left alone.
void apply_table_style(const std::filesystem::path& table, TableStyle style);

}  // namespace lightstripe
