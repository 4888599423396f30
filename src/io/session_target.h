// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The target of a session as people write it.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "core/board.h"
#include "core/error.h"
#include "io/yaml_fields.h"

namespace lightstripe {

/// `square: 10.0` or `square: [10.0, 10.1]`, mm.
struct SquareSize {
  double x = 0, y = 0;
};

void read_field(const detail::YamlNode& node, SquareSize& size, const detail::YamlPlace& place);
void write_field(detail::YamlNode& node, const SquareSize& size);

/// As it is written; what is required is optional here and asked for afterwards.
struct TargetFields {
  TargetType type = TargetType::kCheckerboard;
  std::optional<std::array<int, 2>> inner_corners;
  std::optional<SquareSize> square;
  std::optional<double> marker;
  std::optional<std::string> dictionary;
  std::optional<std::array<int, 2>> grid;
  std::optional<double> pitch, diameter;
  std::optional<std::string> file;
  std::optional<double> rim_mm;
};
template <class V>
void visit_fields(V&& v, TargetFields& o) {
  v("type", o.type);
  v("inner_corners", o.inner_corners);
  v("square", o.square);
  v("marker", o.marker);
  v("dictionary", o.dictionary);
  v("grid", o.grid);
  v("pitch", o.pitch);
  v("diameter", o.diameter);
  v("file", o.file);
  v("rim_mm", o.rim_mm);
}

/// Complaints about what was read, by file and key.
struct Checker {
  std::string file;

  void require(bool holds, const std::string& key, const char* what_is_wrong,
               const std::string& what_to_do) const {
    if (!holds) throw Error(file + ": " + key, what_is_wrong, what_to_do);
  }
  template <class T>
  T given(const std::optional<T>& value, const std::string& key, const std::string& example = "") const {
    require(value.has_value(), key, "is missing", example.empty() ? "give it" : "give it, e.g. " + example);
    return *value;
  }
  std::string text(const std::optional<std::string>& value, const std::string& key) const {
    require(!given(value, key).empty(), key, "is empty", "give a text");
    return *value;
  }
};

/// Checks the keys of each type of board; `folder`: of the session, for Kalibr's file.
Target checked_target(const std::optional<TargetFields>& fields, const std::filesystem::path& folder,
                      const Checker& check);

TargetFields target_fields(const Target& target, const std::string& aprilgrid_file);

}  // namespace lightstripe
