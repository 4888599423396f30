// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Bodies of the reading templates of yaml_fields.h, and the override of one field.
#pragma once

#include "io/yaml_fields.h"

namespace lightstripe::detail {

template <HasEnumNames E>
void read_field(const YamlNode& node, E& value, const YamlPlace& place) {
  std::vector<std::string_view> choices;
  for (const auto& entry : enum_names(value)) choices.push_back(entry.name);
  value = enum_names(value)[bind_choice(node, choices, place)].value;
}

template <class T>
void read_field(const YamlNode& node, std::optional<T>& value, const YamlPlace& place) {
  if (node.kind == YamlNode::Kind::kNull) return value.reset();
  if (!value) value.emplace();
  read_field(node, *value, place);
}

template <class T>
void read_field(const YamlNode& node, std::vector<T>& values, const YamlPlace& place) {
  check_list(node, 0, place);
  values.clear();
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    values.emplace_back();
    read_field(node.items[i], values.back(), place.item(i));
  }
}

template <class T>
void read_field(const YamlNode& node, std::vector<std::pair<std::string, T>>& map, const YamlPlace& place) {
  check_map(node, place);
  map.clear();
  for (const YamlNode& item : node.items) {
    map.emplace_back(item.key, T{});
    read_field(item, map.back().second, place.child(item.key));
  }
}

template <class T, std::size_t N>
void read_field(const YamlNode& node, std::array<T, N>& values, const YamlPlace& place) {
  check_list(node, N, place);
  for (std::size_t i = 0; i < N; ++i) read_field(node.items[i], values[i], place.item(i));
}

template <int N>
void read_field(const YamlNode& node, Eigen::Matrix<double, N, 1>& values, const YamlPlace& place) {
  static_assert(N > 0, "a list of fixed length");
  check_list(node, static_cast<std::size_t>(N), place);
  for (int i = 0; i < N; ++i)
    read_field(node.items[static_cast<std::size_t>(i)], values[i], place.item(static_cast<std::size_t>(i)));
}

/// Hands each field the entry of its name and remembers the names, so that what is left over can be refused.
struct FieldReader {
  const YamlNode& node;
  const YamlPlace& place;
  std::vector<std::string_view> known;

  template <class T>
  void operator()(std::string_view name, T& field, std::string_view = {}) {
    known.push_back(name);
    for (const YamlNode& item : node.items)
      if (item.key == name) read_field(item, field, place.child(name));
  }
  void refuse_unknown() const {
    for (const YamlNode& item : node.items) {
      bool found = false;
      for (const std::string_view name : known) found = found || name == item.key;
      if (!found) fail_unknown_key(place, item.key, item.line, known);
    }
  }
};

template <HasFields T>
void read_field(const YamlNode& node, T& object, const YamlPlace& place) {
  if (node.kind == YamlNode::Kind::kNull) return;  // "extraction:" with nothing behind it: all as it was
  check_map(node, place);
  FieldReader reader{node, place, {}};
  visit_fields(reader, object);
  reader.refuse_unknown();
}

template <class T>
inline constexpr bool kTakesText =
    std::is_same_v<T, std::string> || std::is_same_v<T, std::optional<std::string>>;

template <class T>
void set_field_at(T& object, std::string_view dotted_key, const std::string& text, const YamlPlace& place) {
  if constexpr (HasFields<T>) {
    const std::string_view name = dotted_key.substr(0, dotted_key.find('.'));
    const std::string_view rest = name.size() < dotted_key.size() ? dotted_key.substr(name.size() + 1) : "";
    bool found = false;
    std::vector<std::string_view> known;
    auto set = [&](std::string_view field_name, auto& field, std::string_view = {}) {
      known.push_back(field_name);
      if (field_name != name) return;
      found = true;
      set_field_at(field, rest, text, place.child(name));
    };
    visit_fields(set, object);
    if (!found) fail_unknown_key(place, name, 0, known);
  } else {
    if (!dotted_key.empty()) fail_unknown_key(place, dotted_key, 0, {});
    if constexpr (kTakesText<T>) {
      object = text;
    } else {
      read_field(parse_override(text), object, place);
    }
  }
}

}  // namespace lightstripe::detail
