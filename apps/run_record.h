// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Beside each result: with which version, options and inputs it was made (<output>.run.yaml).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lightstripe {

/// `options` is YAML text of the effective options; inputs are recorded with size and FNV-1a hash of their bytes.
void write_run_record(const std::filesystem::path& output, const std::string& command,
                      const std::vector<std::filesystem::path>& inputs, const std::string& options);

/// Each line moved two spaces to the right.
std::string indented(const std::string& text);

}  // namespace lightstripe
