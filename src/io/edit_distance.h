// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace lightstripe {

/// Typing errors between two words: characters put in, left out, changed, or swapped with their neighbour
/// (Damerau 1964, without edits inside a swapped pair).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace lightstripe
