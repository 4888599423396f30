// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Bodies of the writing templates of yaml_fields.h.
#pragma once

#include <type_traits>

#include "io/yaml_fields.h"

namespace lightstripe::detail {

/// What a field takes, as --help and the shell's completion show it.
template <class T>
struct FieldType {
  static const char* name() {
    if constexpr (HasEnumNames<T>) {
      static const std::string choices = [] {
        std::string text;
        for (const auto& entry : enum_names(T{})) text += (text.empty() ? "" : "|") + std::string(entry.name);
        return text;
      }();
      return choices.c_str();
    } else if constexpr (std::is_same_v<T, bool>) {
      return "true|false";
    } else if constexpr (std::is_integral_v<T>) {
      return "INTEGER";
    } else if constexpr (std::is_floating_point_v<T>) {
      return "NUMBER";
    } else if constexpr (std::is_same_v<T, std::string>) {
      return "TEXT";
    } else {
      return "VALUE";
    }
  }
};
template <class T>
struct FieldType<std::optional<T>> : FieldType<T> {};

template <HasEnumNames E>
void write_field(YamlNode& node, const E& value) {
  write_field(node, std::string(enum_name(value)));
}

template <class T>
void write_field(YamlNode& node, const std::optional<T>& value) {
  if (value) write_field(node, *value);
}

template <class T>
void write_field(YamlNode& node, const std::vector<T>& values) {
  node.kind = YamlNode::Kind::kSequence;
  for (const T& value : values) write_field(node.items.emplace_back(), value);
}

template <class T>
void write_field(YamlNode& node, const std::vector<std::pair<std::string, T>>& map) {
  node.kind = YamlNode::Kind::kMap;
  for (const auto& [key, value] : map) {
    node.items.emplace_back().key = key;
    write_field(node.items.back(), value);
  }
}

template <class T, std::size_t N>
void write_field(YamlNode& node, const std::array<T, N>& values) {
  node.kind = YamlNode::Kind::kSequence;
  for (const T& value : values) write_field(node.items.emplace_back(), value);
}

template <int N>
void write_field(YamlNode& node, const Eigen::Matrix<double, N, 1>& values) {
  node.kind = YamlNode::Kind::kSequence;
  for (int i = 0; i < N; ++i) write_field(node.items.emplace_back(), values[i]);
}

struct FieldWriter {
  YamlNode& node;

  template <class T>
  void operator()(std::string_view name, T& field, std::string_view comment = {}) {
    YamlNode& item = node.items.emplace_back();
    item.key = std::string(name);
    item.comment = std::string(comment);
    item.type = FieldType<T>::name();
    write_field(item, field);
  }
};

template <HasFields T>
void write_field(YamlNode& node, const T& object) {
  node.kind = YamlNode::Kind::kMap;
  T copy = object;  // visit_fields hands out references that could be written through
  visit_fields(FieldWriter{node}, copy);
}

}  // namespace lightstripe::detail
