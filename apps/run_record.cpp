// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/run_record.h"

#include <fmt/format.h>

#include <cstdint>

#include "io/atomic_file.h"

namespace lightstripe {
namespace {

// FNV-1a, 64 bits (Fowler, Noll, Vo): tells whether an input has changed, it is no protection against forgery.
std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

std::string indented(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    out += "  " + text.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return out;
}

void write_run_record(const std::filesystem::path& output, const std::string& command,
                      const std::vector<std::filesystem::path>& inputs, const std::string& options) {
  std::string text = fmt::format("lightstripe: {}\ncommand: {}\ninputs:\n", LIGHTSTRIPE_VERSION, command);
  for (const auto& input : inputs) {
    const std::string bytes = read_file(input);
    text += fmt::format("  - {{file: \"{}\", bytes: {}, fnv1a: \"{:016x}\"}}\n", input.string(), bytes.size(), fnv1a(bytes));
  }
  write_file(output.string() + ".run.yaml", text + options);
}

}  // namespace lightstripe
