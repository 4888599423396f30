// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/sensor_name.h"

#include <algorithm>

#include "core/error.h"

namespace lightstripe {

void check_sensor_name(const std::string& name, const std::string& key) {
  const bool control = std::any_of(name.begin(), name.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
  if (name.empty() || name.front() == '.' || control || name.find_first_of("/\\") != std::string::npos)
    throw Error(key, "cannot be a sensor's name, since files are named after it",
                "use letters, digits, - and _, no slash, and no dot at the beginning");
}

}  // namespace lightstripe
