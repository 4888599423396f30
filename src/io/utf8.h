// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace lightstripe {

/// Bytes of the UTF-8 character that begins at `at` (RFC 3629: no overlong form, no surrogate, nothing beyond
/// U+10FFFF); 0 where there is none.
std::size_t utf8_length(std::string_view text, std::size_t at);

bool is_utf8(std::string_view text);

}  // namespace lightstripe
