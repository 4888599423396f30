// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace lightstripe {

/// The noun that agrees with a count: "frame" after 1, "frames" after all others. `many` is given where the
/// plural is not `one` and an s, or where a verb agrees too: noun_of(n, "frame has", "frames have").
std::string noun_of(std::integral auto count, std::string_view one, std::string_view many = {}) {
  if (count == 1) return std::string(one);
  return many.empty() ? std::string(one) + "s" : std::string(many);
}

/// A count with its noun, for messages: "1 frame", "3 frames".
std::string counted(std::integral auto count, std::string_view one, std::string_view many = {}) {
  return std::to_string(count) + " " + noun_of(count, one, many);
}

}  // namespace lightstripe
