// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How a scan's or session's `background` is read and written: a text, or a map from the sensors' names.
#pragma once

#include "io/session_file.h"

namespace lightstripe {

void read_field(const detail::YamlNode& node, Backgrounds& value, const detail::YamlPlace& place);
void write_field(detail::YamlNode& node, const Backgrounds& value);

}  // namespace lightstripe
