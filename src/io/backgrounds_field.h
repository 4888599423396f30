// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The keys that a session and a scan share: `background`, a text or a map from the sensors' names, and
// `polarity`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/session_file.h"

namespace lightstripe {

void read_field(const detail::YamlNode& node, Backgrounds& value, const detail::YamlPlace& place);
void write_field(detail::YamlNode& node, const Backgrounds& value);

/// How a file speaks of its sensors, in messages.
struct SensorWords {
  const char* sensors_of;  ///< "frames"
  const char* key;         ///< that lists them
  const char* one_each;    ///< what to write where each sensor needs its own background
};

/// An Error where a background is empty, one for several sensors, or of a sensor that is not among `sensors`.
void check_backgrounds(const Backgrounds& backgrounds, const std::vector<std::string>& sensors,
                       const std::string& file, const SensorWords& words);

/// The file's `extraction`, with `polarity` as one of its entries. An Error where both say it.
YamlSubtree extraction_part(const YamlSubtree& extraction, const std::optional<std::string>& polarity,
                            const std::filesystem::path& file);

}  // namespace lightstripe
