// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Beside each result: with which version, options and inputs it was made (<output>.run.yaml).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lightstripe {

/// `options` is YAML text of the effective options; inputs are recorded with size and SHA-256, as
/// sha256sum prints it.
void write_run_record(const std::filesystem::path& output, const std::string& command,
                      const std::vector<std::filesystem::path>& inputs, const std::string& options);

struct FileFacts {
  std::uint64_t bytes = 0;
  std::string sha256;  ///< in hexadecimal digits, as sha256sum prints it
};
/// An Error where the file cannot be read.
FileFacts facts_of(const std::filesystem::path& path);

/// FNV-1a, 64 bits (Fowler, Noll, Vo), over text that may come in parts: tells whether something has changed,
/// it is no protection against forgery.
inline constexpr std::uint64_t kFnvStart = 0xcbf29ce484222325ULL;
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t before = kFnvStart);

/// Each line moved two spaces to the right.
std::string indented(const std::string& text);

}  // namespace lightstripe
