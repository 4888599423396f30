// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Strict YAML for structs that list their fields (core/fields.h): unknown, repeated and ill-typed keys are
// errors that name file, key and line. yaml-cpp stays inside this folder.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/fields.h"
#include "io/yaml_fields.h"

namespace lightstripe {

/// Sets the fields that the file gives; the others keep their values. An Error reads
/// "<file>: <dotted.key> (line N): <what is wrong>; <what to do>". After an Error the object is part old,
/// part new.
template <HasFields T>
void read_yaml(const std::filesystem::path& path, T& object) {
  detail::read_field(detail::parse_yaml_file(path), object, {path.string(), ""});
}

/// As read_yaml, for a part that a file reader kept; an empty part changes nothing.
template <HasFields T>
void read_subtree(const YamlSubtree& part, T& object) {
  const detail::YamlPlace place = detail::place_of(part);
  if (!part.empty()) detail::read_field(detail::parse_yaml(part.text, place), object, place);
}

/// One entry of a file whose other keys belong to somebody else; empty if the file has none of that name.
YamlSubtree read_entry(const std::filesystem::path& path, std::string_view key);

/// A text as it stands in YAML, in quotes and escaped where it would be misread.
std::string yaml_text(std::string_view text);

/// YAML text that read_yaml reads back to the same bits. With comments it explains the fields
/// and shows those that are not given as "# key:".
template <HasFields T>
std::string dump_yaml(const T& object, bool comments = false) {
  detail::YamlNode node;
  detail::write_field(node, object);
  return detail::emit_yaml(node, comments);
}

/// Overrides one field by its dotted name ("thresholds.low", "3") as the command line does; text for a list
/// or a number is read as YAML, a text field takes it as it stands. Messages begin with `origin`
/// ("--extraction"), if given.
template <HasFields T>
void set_field(T& object, std::string_view dotted_key, const std::string& text,
               const std::string& origin = "") {
  detail::set_field_at(object, dotted_key, text, {"", origin});
}

/// A leaf of a struct's fields, for --help and tests.
struct FieldText {
  std::string key;    ///< dotted
  std::string value;  ///< as YAML, empty where not given
  std::string comment;
  std::string type;  ///< NUMBER, INTEGER, TEXT, or the names that may be given: "left|right"
};

template <HasFields T>
std::vector<FieldText> list_fields(const T& object) {
  detail::YamlNode node;
  detail::write_field(node, object);
  std::vector<FieldText> fields;
  detail::for_each_leaf(
      node, "", [&fields](const std::string& key, const std::string& value, const detail::YamlNode& leaf) {
        fields.push_back({key, value, leaf.comment, leaf.type});
      });
  return fields;
}

}  // namespace lightstripe
