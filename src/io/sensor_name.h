// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a sensor may be called.
#pragma once

#include <string>

namespace lightstripe {

/// An Error where a text cannot name a sensor, since files are named after it: empty, with a slash or a
/// control character, or beginning with a dot. `key` stands in the message.
void check_sensor_name(const std::string& name, const std::string& key);

}  // namespace lightstripe
