// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/backgrounds_field.h"

namespace lightstripe {

std::string Backgrounds::pattern(const std::string& sensor) const {
  for (const auto& [name, files] : of_sensor)
    if (name.empty() || name == sensor) return files;
  return "";
}

void read_field(const detail::YamlNode& node, Backgrounds& value, const detail::YamlPlace& place) {
  if (node.kind == detail::YamlNode::Kind::kMap) return detail::read_field(node, value.of_sensor, place);
  std::string files;
  detail::read_field(node, files, place);
  value.of_sensor = {{"", files}};
}

void write_field(detail::YamlNode& node, const Backgrounds& value) {
  if (value.of_sensor.size() == 1 && value.of_sensor.front().first.empty())
    return detail::write_field(node, value.of_sensor.front().second);
  detail::write_field(node, value.of_sensor);
}

}  // namespace lightstripe
