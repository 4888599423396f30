// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/backgrounds_field.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

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

void check_backgrounds(const Backgrounds& backgrounds, const std::vector<std::string>& sensors,
                       const std::string& file, const SensorWords& words) {
  for (const auto& [sensor, pattern] : backgrounds.of_sensor) {
    if (!sensor.empty() && std::find(sensors.begin(), sensors.end(), sensor) == sensors.end())
      throw Error(fmt::format("{}: background.{}", file, sensor),
                  fmt::format("names no sensor of {}", words.sensors_of),
                  fmt::format("use a name from {}", words.key));
    if (sensor.empty() && sensors.size() > 1)
      throw Error(file + ": background", "is one for several sensors",
                  fmt::format("give each its own, {}", words.one_each));
    if (pattern.empty())
      throw Error(file + ": background", "is empty",
                  "give a file or a pattern of pictures with the laser off");
  }
}

YamlSubtree extraction_part(const YamlSubtree& extraction, const std::optional<std::string>& polarity,
                            const std::filesystem::path& file) {
  YamlSubtree part = extraction;
  if (part.origin.empty()) part.origin = file.string() + ": extraction";
  if (polarity) detail::add_entry(part, "polarity", *polarity);
  return part;
}

}  // namespace lightstripe
