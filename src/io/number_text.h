// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Numbers to text and back, whatever the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lightstripe {

/// A whole text that is one finite decimal number ("-1.5e3", "+2"); nothing for anything else, NaN and
/// infinity included.
std::optional<double> parse_number(std::string_view text);

/// A whole text that is one whole number within the type's range ("3.0" is not).
std::optional<std::int64_t> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// The shortest text that reads back to the same bits.
void append_shortest(std::string& out, double value);
std::string shortest_text(double value);

/// At most `decimals` (0..9) digits after the point, zeros at the end left out ("12.5"); nothing for NaN and
/// infinity.
void append_decimals(std::string& out, double value, int decimals);

void append_integer(std::string& out, std::int64_t value);

}  // namespace lightstripe
