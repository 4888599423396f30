// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// An outline that is accepted is closed, counterclockwise and of finite length.

#include <cmath>
#include "fuzz_input.h"

#include "core/error.h"
#include "io/nominal_outlines.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".yaml";

void read_input(const std::filesystem::path& file) {
  const Outline outline = read_nominal(file.string());
  LIGHTSTRIPE_CHECK(outline.closed(), "an accepted outline is closed");
  LIGHTSTRIPE_CHECK(section_properties(outline).area > 0, "an accepted outline runs counterclockwise");
  for (const auto& segment : outline.segments)
    LIGHTSTRIPE_CHECK(std::isfinite(length(segment)), "an accepted segment has a length");
}

}  // namespace lightstripe::fuzz
