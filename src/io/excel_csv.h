// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Tables as Excel opens them by a double click where the decimal mark is a comma.
#pragma once

#include <string>
#include <string_view>

namespace lightstripe {

/// Of a CSV text: cells parted by semicolons, numbers with a decimal comma, UTF-8 with a byte order mark,
/// lines ended by CR LF. Texts stay as they are (quoted where they hold a semicolon).
std::string excel_csv(std::string_view csv);

}  // namespace lightstripe
