// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Signs of numbers in file names, inside src/io.
#pragma once

#include <string_view>

namespace lightstripe {

/// Whether the character at `at`, before a digit, is a number's minus sign and no hyphen: at the text's start
/// or behind a separator ("-5", "x_-5", "z=-5"; not "img-5", "2026-11-27").
inline bool is_minus_sign(std::string_view text, std::size_t at) {
  constexpr std::string_view kBefore = "_ =(,;";
  if (at >= text.size() || text[at] != '-') return false;
  return at == 0 || kBefore.find(text[at - 1]) != std::string_view::npos;
}

}  // namespace lightstripe
