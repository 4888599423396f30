// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What can be read is finite, and written back to a file that can be read.

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "fuzz_input.h"
#include "measure/profile_formats.h"

namespace lightstripe::fuzz {

const std::string_view kExtension = ".ban";

void read_input(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const RecordedProfile profile = read_miniprof(in, file.string(), ObjectKind::kRail);
  for (const auto& point : profile.points)
    LIGHTSTRIPE_CHECK(point.allFinite(), "a point that was read is finite");
  LIGHTSTRIPE_CHECK(profile.points.size() >= 10, "an accepted profile has ten points");
  std::stringstream written;
  write_miniprof(written, profile);
  LIGHTSTRIPE_CHECK(!written.str().empty(), "a profile has a text");
}

}  // namespace lightstripe::fuzz
