// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/yaml_node.h"

#include "core/error.h"

namespace lightstripe::detail {

YamlPlace YamlPlace::child(std::string_view name) const {
  return {file, key.empty() ? std::string(name) : key + "." + std::string(name)};
}

YamlPlace YamlPlace::item(std::size_t index) const { return {file, key + "[" + std::to_string(index) + "]"}; }

void fail_at(const YamlPlace& place, int line, const std::string& what_is_wrong,
             const std::string& what_to_do) {
  std::string subject = place.file;
  if (!place.key.empty()) subject += (subject.empty() ? "" : ": ") + place.key;
  if (line > 0) subject += " (line " + std::to_string(line) + ")";
  throw Error(subject, what_is_wrong, what_to_do);
}

}  // namespace lightstripe::detail
