// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How each type of field is read from and written to a YAML tree. A type of one's own joins by overloading
// read_field(const detail::YamlNode&, X&, const detail::YamlPlace&) and write_field(detail::YamlNode&, const
// X&) beside it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/fields.h"
#include "io/yaml_node.h"

namespace lightstripe {

/// A part of a YAML file kept as it stands, to be bound later by whoever knows its fields
/// (the extraction options of a scan). Empty = not given.
struct YamlSubtree {
  std::string text;    ///< YAML text of the part, every entry on its line of the file
  std::string origin;  ///< "scan.yaml: extraction", for messages

  bool empty() const { return text.find_first_not_of(" \t\r\n") == std::string::npos; }
};

namespace detail {

void read_field(const YamlNode& node, bool& value, const YamlPlace& place);
void read_field(const YamlNode& node, int& value, const YamlPlace& place);
void read_field(const YamlNode& node, std::int64_t& value, const YamlPlace& place);
void read_field(const YamlNode& node, std::uint64_t& value, const YamlPlace& place);
void read_field(const YamlNode& node, double& value, const YamlPlace& place);
void read_field(const YamlNode& node, std::string& value, const YamlPlace& place);
void read_field(const YamlNode& node, YamlSubtree& value, const YamlPlace& place);

void write_field(YamlNode& node, bool value);
void write_field(YamlNode& node, int value);
void write_field(YamlNode& node, std::int64_t value);
void write_field(YamlNode& node, std::uint64_t value);
void write_field(YamlNode& node, double value);
void write_field(YamlNode& node, const std::string& value);
void write_field(YamlNode& node, const YamlSubtree& value);

/// Index of the choice that the node names; an Error lists the choices.
std::size_t bind_choice(const YamlNode& node, const std::vector<std::string_view>& choices,
                        const YamlPlace& place);
/// Checks that the node is a list, of `length` entries unless that is 0.
void check_list(const YamlNode& node, std::size_t length, const YamlPlace& place);
/// Checks that the node is a map.
void check_map(const YamlNode& node, const YamlPlace& place);
[[noreturn]] void fail_unknown_key(const YamlPlace& place, std::string_view key, int line,
                                   const std::vector<std::string_view>& known);
YamlPlace place_of(const YamlSubtree& part);
/// Adds `key: text` to the part, which has to be a map without that key.
void add_entry(YamlSubtree& part, const std::string& key, const std::string& text);
/// The text of an override as a tree: YAML, or the plain text where it is none.
YamlNode parse_override(const std::string& text);
void for_each_leaf(const YamlNode& node, const std::string& key,
                   const std::function<void(const std::string&, const std::string&, const YamlNode&)>& visit);

// Seen by each other's bodies, whatever the nesting: a struct in a vector in an optional.
template <HasEnumNames E>
void read_field(const YamlNode& node, E& value, const YamlPlace& place);
template <class T>
void read_field(const YamlNode& node, std::optional<T>& value, const YamlPlace& place);
template <class T>
void read_field(const YamlNode& node, std::vector<T>& values, const YamlPlace& place);
template <class T>
void read_field(const YamlNode& node, std::vector<std::pair<std::string, T>>& map, const YamlPlace& place);
template <class T, std::size_t N>
void read_field(const YamlNode& node, std::array<T, N>& values, const YamlPlace& place);
template <int N>
void read_field(const YamlNode& node, Eigen::Matrix<double, N, 1>& values, const YamlPlace& place);
template <HasFields T>
void read_field(const YamlNode& node, T& object, const YamlPlace& place);

template <HasEnumNames E>
void write_field(YamlNode& node, const E& value);
template <class T>
void write_field(YamlNode& node, const std::optional<T>& value);
template <class T>
void write_field(YamlNode& node, const std::vector<T>& values);
template <class T>
void write_field(YamlNode& node, const std::vector<std::pair<std::string, T>>& map);
template <class T, std::size_t N>
void write_field(YamlNode& node, const std::array<T, N>& values);
template <int N>
void write_field(YamlNode& node, const Eigen::Matrix<double, N, 1>& values);
template <HasFields T>
void write_field(YamlNode& node, const T& object);

}  // namespace detail
}  // namespace lightstripe

#include "io/yaml_read-inl.h"
#include "io/yaml_write-inl.h"
