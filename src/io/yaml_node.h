// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A YAML text as a plain tree that remembers keys in order and lines; yaml-cpp stays in yaml_parse.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lightstripe::detail {

struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };

  Kind kind = Kind::kNull;
  int line = 0;                 ///< counted from 1, of the key if it has one; 0 = not from a file
  bool quoted = false;          ///< scalar: text, even if it looks like a number
  std::string text;             ///< scalar
  std::string key;              ///< its name in the map it is in
  std::string comment;          ///< written behind it
  const char* type = "";        ///< of a written field, for --help: NUMBER, "auto|gray" ...
  std::vector<YamlNode> items;  ///< of a sequence, or of a map in the file's order
};

/// Where a node stands, for messages: "scan.yaml: travel.step (line 3)".
struct YamlPlace {
  std::string file;
  std::string key;

  YamlPlace child(std::string_view name) const;
  YamlPlace item(std::size_t index) const;
};

/// Throws Error(place and line, what_is_wrong, what_to_do).
[[noreturn]] void fail_at(const YamlPlace& place, int line, const std::string& what_is_wrong,
                          const std::string& what_to_do);

/// The one document of the text. An Error names `place` and line: no YAML, empty, a key given twice, deeper
/// than 64 levels, aliases, tags, more than one document.
YamlNode parse_yaml(const std::string& text, const YamlPlace& place);

/// As parse_yaml; files up to 16 MiB.
YamlNode parse_yaml_file(const std::filesystem::path& path);

/// YAML text: short parts on one line, the others as blocks. Entries that are null are left out; with
/// comments they stand there as "# key:".
std::string emit_yaml(const YamlNode& node, bool comments);

/// YAML text with every entry on the line of the file that the node came from, so that messages about it stay
/// true.
std::string emit_on_lines(const YamlNode& node);

/// All on one line.
std::string emit_flow(const YamlNode& node);

/// Whether a text has to be quoted to be read as this text everywhere.
bool needs_quotes(std::string_view text);

}  // namespace lightstripe::detail
